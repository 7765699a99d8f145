// SPDX-License-Identifier: MIT
//
// peer_odeint.cc METHOD N - laps of bench.h: a step of y' = -y by Boost odeint; compile with -O3 -march=native
#include "bench.h"

#include <boost/numeric/odeint.hpp>
#include <boost/version.hpp>
#include <string>
#include <vector>

using state = std::vector<double>;

// A call, as for the other contenders.
__attribute__((noinline)) static void decay(const state &y, state &f, double)
{
    for (std::size_t i = 0; i < y.size(); i++) f[i] = -y[i];
}

// Like the other contenders: from a y that stays, with its slope at hand where the method can use it.
template <class Stepper, bool first_same_as_last> struct work {
    Stepper stepper;
    state y, slope, z, last;
    static void step(void *user)
    {
        auto *w = static_cast<work *>(user);
        if constexpr (first_same_as_last) w->stepper.do_step(decay, w->y, w->slope, 0., w->z, w->last, 1e-7);
        else w->stepper.do_step(decay, w->y, w->slope, 0., w->z, 1e-7);
    }
    explicit work(std::size_t n) : y(n, 1.), slope(n, -1.), z(n), last(n)
    {
        char who[80];
        snprintf(who, sizeof who, "odeint of Boost %d.%d, -O3 -march=native", BOOST_VERSION / 100000, BOOST_VERSION / 100 % 1000);
        bench_laps(who, step, this);
    }
};

int main(int argc, char **argv)
{
    using namespace boost::numeric::odeint;
    const std::string method = argc > 1 ? argv[1] : "dp5";
    const std::size_t n = argc > 2 ? std::stoul(argv[2]) : 10;
    if (method == "rk4") work<runge_kutta4<state>, false> run(n);
    if (method == "dp5") work<runge_kutta_dopri5<state>, true> run(n);
    if (method == "dop853") work<runge_kutta_fehlberg78<state>, false> run(n);
    return 1;
}
