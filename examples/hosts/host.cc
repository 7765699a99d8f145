/* SPDX-License-Identifier: MIT

   host.cc - waveform.h, iqn.h and rk.h in a C++17 program: classes own the memory, the headers work
   in it

   Two masses between three springs, one solver each; both read the other's waveform, quasi-Newton
   closes the loop:

       u1'' + 20 pi^2 u1 = 16 pi^2 u2(t)    Runge-Kutta 4, 5 steps in a window
       u2'' + 20 pi^2 u2 = 16 pi^2 u1(t)    generalized-alpha, 100 steps in a window

   The answer: the largest errors published by Rodenberg and Uekermann, arXiv 2511.07616 (2025),
   cubic, window 0.1. */
#include "iqn.h"
#include "rk.h"
#include "waveform.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <vector>

static int checked(int status, const char *message)
{
    if (status < 0) throw std::runtime_error(message);
    return status;
}

/* A waveform of n numbers and its coefficients.  The header keeps a pointer to the elements of
   memory_, which stay where they are when a vector is moved: moving works, copying does not. */
class Waveform
{
  public:
    Waveform(int degree, int capacity, std::ptrdiff_t n)
        : memory_(wf_size(n, degree, capacity) / sizeof(double) + 1),
          coefficient_(static_cast<std::size_t>(capacity * n))
    {
        check(wf_make(&w_, n, degree, capacity, memory_.data(), memory_.size() * sizeof(double)));
    }
    Waveform(const Waveform &) = delete;
    Waveform(Waveform &&) = default;

    double *write(double t) { return wf_column(w_, check(wf_push(w_, t, 0))); }
    void fit() { check(wf_fit(w_, coefficient_.data())); }
    void read(double t, double *out) const { check(wf_eval(w_, t, 0, coefficient_.data(), out)); }
    void rollback() { check(wf_rollback(w_)); }
    void advance() { check(wf_advance(w_, 0)); }
    double *unknowns() { return wf_column(w_, wf_start(w_) + 1); } // what an iteration changes

  private:
    static int check(int status) { return checked(status, wf_message(status)); }

    std::vector<double> memory_, coefficient_;
    wf *w_ = nullptr;
};

class QuasiNewton
{
  public:
    QuasiNewton(std::ptrdiff_t n, int pairs) : memory_(iqn_size(n, pairs, 1) / sizeof(double) + 1)
    {
        check(iqn_make(&q_, n, pairs, 1, memory_.data(), memory_.size() * sizeof(double)));
    }
    QuasiNewton(const QuasiNewton &) = delete;
    QuasiNewton(QuasiNewton &&) = default;

    void set(int key, double value) { check(iqn_set(q_, key, value)); }
    bool step(double *x, const double *hx) // true: x is the next input; false: x is the answer
    {
        check(iqn_step(q_, x, hx));
        if (iqn_converged(q_) > 1) throw std::runtime_error("no convergence");
        return !iqn_converged(q_);
    }
    int commit() // returns the window's iterations
    {
        const int iterations = static_cast<int>(iqn_get(q_, IQN_ITERATIONS));
        check(iqn_commit(q_));
        return iterations;
    }

  private:
    static int check(int status) { return checked(status, iqn_message(status)); }
    std::vector<double> memory_;
    iqn *q_ = nullptr;
};

static const double pi = 3.14159265358979323846, k12 = 16 * pi * pi, k = 20 * pi * pi;

/* A solver's whole state is one value: to roll back a window is an assignment. */
struct Mass {
    double u, v, a, error; // error: the largest so far
    void compare(double t, double sign)
    {
        const double exact = (std::cos(2 * pi * t) + sign * std::cos(6 * pi * t)) / 2;
        error = std::max(error, std::fabs(u - exact));
    }
};

static Mass runge_kutta(Mass m, double t0, double h, int steps, const Waveform &in, Waveform &out)
{
    const rk_table *T = rk_find("rk4");
    double slope[4 * 2], y[2] = {m.u, m.v}, z[2], w;
    for (int j = 1; j <= steps; ++j) {
        const double t = t0 + (j - 1) * h;
        for (int i = 0; i < T->stages; ++i) {
            rk_stage(T, i, h, 2, y, slope, 2, z);
            in.read(t + T->c[i] * h, &w);
            slope[2 * i] = z[1];
            slope[2 * i + 1] = k12 * w - k * z[0];
        }
        rk_finish(T, h, 2, y, slope, 2, y, nullptr);
        *out.write(t0 + j * h) = m.u = y[0];
        m.v = y[1];
        m.compare(t0 + j * h, 1);
    }
    return m;
}

static Mass generalized_alpha(Mass m, double t0, double h, int steps, const Waveform &in,
                              Waveform &out)
{
    const double af = 0.4, am = 0.2, gamma = 0.5 - am + af, beta = (gamma + 0.5) / 4;
    const double m0 = (1 - am) / (beta * h * h), m1 = (1 - am) / (beta * h);
    const double m2 = (1 - am - 2 * beta) / (2 * beta);
    for (int j = 1; j <= steps; ++j) {
        double w;
        in.read(t0 + (j - 1 + 1 - af) * h, &w);
        const double force = k12 * w - af * k * m.u + m0 * m.u + m1 * m.v + m2 * m.a;
        const double u = force / (k * (1 - af) + m0);
        const double a = (u - m.u - h * m.v) / (beta * h * h) - (1 - 2 * beta) / (2 * beta) * m.a;
        m.v += h * ((1 - gamma) * m.a + gamma * a);
        *out.write(t0 + j * h) = m.u = u;
        m.a = a;
        m.compare(t0 + j * h, -1);
    }
    return m;
}

int main()
try {
    const int windows = 10, na = 5, nb = 100;
    const double window = 1.0 / windows, e_A = 0.0003007235641515, e_B = 0.0003146352046766;
    Mass A{1, 0, -k, 0}, B{0, 0, k12, 0};
    Waveform u1(3, na + 1, 1), u2(3, nb + 1, 1);
    Waveform guess(3, nb + 1, 1); // what A reads in place of u2
    QuasiNewton q(nb, 20);
    int iterations = 0;

    q.set(IQN_OMEGA, 1);
    q.set(IQN_TOL_RELATIVE, 1e-11);
    *u1.write(0) = A.u;
    *u2.write(0) = *guess.write(0) = B.u;
    for (int n = 0; n < windows; ++n) {
        const double t0 = n * window;
        const Mass A0 = A, B0 = B;
        for (int j = 1; j <= nb; ++j) *guess.write(t0 + j * window / nb) = B0.u;
        do {
            guess.fit();
            u1.rollback();
            A = runge_kutta(A0, t0, window / na, na, guess, u1);
            u1.fit();
            u2.rollback();
            B = generalized_alpha(B0, t0, window / nb, nb, u1, u2);
        } while (q.step(guess.unknowns(), u2.unknowns()));
        iterations += q.commit();
        for (Waveform *w : {&u1, &u2, &guess}) w->advance();
    }
    std::printf("e_A %.16g\npublished_e_A %.16g\ne_B %.16g\npublished_e_B %.16g\n"
                "iterations_average %.1f\n", A.error,
                e_A, B.error, e_B, static_cast<double>(iterations) / windows);
    return std::fabs(A.error - e_A) <= 1e-9 && std::fabs(B.error - e_B) <= 1e-9 ? 0 : 1;
} catch (const std::exception &e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
}
