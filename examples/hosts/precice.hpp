/* SPDX-License-Identifier: MIT

   precice.hpp - this is not preCICE: a stand-in that runs two solvers written for it in one process

   The same as precice.py, for C++17: waveform.h interpolates, iqn.h accelerates.  In a folder named
   precice, so that solvers find <precice/precice.hpp>, and with the two headers beside it:

      c++ -std=c++17 -I. -Dmain=first_main -c left.cc -o left.o      two solvers, unmodified
      c++ -std=c++17 -I. -Dmain=second_main -c right.cc -o right.o
      c++ -std=c++17 -I. -DPRECICE_MAIN -x c++ -c precice/precice.hpp -o run.o
      c++ left.o right.o run.o -pthread -o coupled
      ./coupled ARGUMENTS OF LEFT -- ARGUMENTS OF RIGHT

   From a program of your own: precice::run(left, right), two functions, each of which makes one
   precice::Participant.  The solvers are threads of which one runs at a time, first, second, first
   ... What the configuration asks for beyond `known` below stops with the name of the element.
   examples/precice.md has the map from the configuration to the two headers. */
#ifndef PRECICE_HPP
#define PRECICE_HPP
#ifdef PRECICE_MAIN
#  define WF_IMPLEMENTATION
#  define IQN_IMPLEMENTATION
#endif
#include "iqn.h"
#include "waveform.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <condition_variable>
#include <cstdio>
#include <deque>
#include <exception>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

// clang-format off
namespace precice {

using VertexID = int;
using std::string_view;

struct Error : std::runtime_error { using std::runtime_error::runtime_error; };

template <class T> struct span { // of any container
    span(T *first, std::size_t count) : data(first), size(count) {}
    template <class C> span(C &&c) : data(c.data()), size(c.size()) {}
    T *data;
    std::size_t size;
};

class Participant;

namespace impl {

using Key = std::pair<std::string, std::string>; // mesh, data
using Numbers = std::vector<double>;

inline int ok(int status)
{
    if (status < 0) throw Error(status > -200 ? wf_message(status) : iqn_message(status));
    return status;
}

inline std::ptrdiff_t length(const Numbers &v) { return static_cast<std::ptrdiff_t>(v.size()); }

/* ---- the configuration ----------------------------------------------------------------------- */

struct Element {
    std::string tag;
    std::map<std::string, std::string> attributes;
    std::deque<Element> children;

    std::string get(const std::string &name, const std::string &otherwise = "") const
    {
        const auto found = attributes.find(name);
        return found == attributes.end() ? otherwise : found->second;
    }
    bool yes(const std::string &name, const std::string &otherwise) const
    {
        const std::string s = get(name, otherwise);
        return s == "1" || s == "true" || s == "True" || s == "yes" || s == "on";
    }
    bool is(const std::string &prefix) const { return tag.compare(0, prefix.size(), prefix) == 0; }
    std::vector<const Element *> all(const std::string &prefix) const // children of children, too
    {
        std::vector<const Element *> found;
        for (const Element &e : children) {
            if (e.is(prefix)) found.push_back(&e);
            for (const Element *inner : e.all(prefix)) found.push_back(inner);
        }
        return found;
    }
    const Element *one(const std::string &prefix) const
    {
        const auto found = all(prefix);
        if (found.size() > 1) throw Error("more than one <" + prefix + "> is not supported");
        return found.empty() ? nullptr : found[0];
    }
    double value(const std::string &name, double otherwise) const
    {
        const Element *e = one(name);
        return e ? std::stod(e->get("value")) : otherwise;
    }
};

class Reader { // tags and attributes of XML; text and comments are passed over
  public:
    explicit Reader(const std::string &file)
    {
        std::ifstream in(file);
        if (!in) throw Error("cannot read " + file);
        text_.assign(std::istreambuf_iterator<char>(in), {});
    }
    bool read(Element &parent) // the next child, or false behind the last one
    {
        for (at_ = text_.find('<', at_); at_ != std::string::npos; at_ = text_.find('<', at_)) {
            if (text_.compare(at_, 4, "<!--") == 0) skip("-->");
            else if (text_[at_ + 1] == '?' || text_[at_ + 1] == '!') skip(">");
            else break;
        }
        if (at_ == std::string::npos) return false;
        if (text_[at_ + 1] == '/') return skip(">"), false;
        Element e;
        at_++;
        e.tag = word(" \t\r\n/>");
        for (space(); text_.at(at_) != '>' && text_.at(at_) != '/'; space()) {
            const std::string name = word(" \t\r\n=");
            at_ = text_.find_first_of("\"'", at_);
            const std::string quote(1, text_.at(at_++));
            e.attributes[name] = word(quote);
            at_++;
        }
        const bool empty = text_[at_] == '/';
        skip(">");
        while (!empty && read(e)) {}
        parent.children.push_back(std::move(e));
        return true;
    }

  private:
    void skip(const char *end) { at_ = text_.find(end, at_) + std::string(end).size(); }
    void space() { at_ = text_.find_first_not_of(" \t\r\n", at_); }
    std::string word(const std::string &ends)
    {
        const std::size_t from = at_;
        at_ = std::min(text_.find_first_of(ends, at_), text_.size());
        return text_.substr(from, at_ - from);
    }
    std::string text_;
    std::size_t at_ = 0;
};

/* Elements and their attributes; NAME=VALUE: no other value is supported, NAME=: no effect. */
inline const std::map<std::string, std::string> known = {
    {"precice-configuration", "experimental= wait-in-finalize="},
    {"data:scalar", "name waveform-degree"}, {"data:vector", "name waveform-degree"},
    {"mesh", "name dimensions"}, {"use-data", "name"}, {"participant", "name"},
    {"provide-mesh", "name"},
    {"receive-mesh", "name from api-access=false geometric-filter= safety-factor="},
    {"write-data", "name mesh"}, {"read-data", "name mesh"},
    {"mapping:nearest-neighbor", "direction from to constraint=consistent"},
    {"coupling-scheme:serial-explicit", ""}, {"coupling-scheme:parallel-explicit", ""},
    {"coupling-scheme:serial-implicit", ""}, {"coupling-scheme:parallel-implicit", ""},
    {"participants", "first second"}, {"exchange", "data mesh from to initialize substeps"},
    {"max-time", "value"}, {"time-window-size", "value method=fixed"}, {"max-iterations", "value"},
    {"absolute-convergence-measure", "limit data mesh suffices=false strict=false"},
    {"relative-convergence-measure", "limit data mesh suffices=false strict=false"},
    {"acceleration:constant", ""}, {"acceleration:aitken", ""},
    {"acceleration:IQN-ILS", "reduced-time-grid on-bound-violation=ignore"},
    {"acceleration:IQN-IMVJ", "reduced-time-grid on-bound-violation=ignore"},
    {"relaxation", "value"}, {"initial-relaxation", "value enforce=false"},
    {"data", "name mesh"}, {"max-used-iterations", "value"}, {"time-windows-reused", "value"},
    {"preconditioner", "type update-on-threshold= freeze-after=-1"}};
inline const std::set<std::string> ignored = {
    "log", "m2n", "intra-comm", "profiling", "export", "watch-point", "watch-integral", "filter"};

inline void check(const Element &parent, std::set<std::string> &found)
{
    for (const Element &e : parent.children) {
        if (ignored.count(e.tag.substr(0, e.tag.find(':')))) {
            found.insert("<" + e.tag + ">");
            continue;
        }
        if (!known.count(e.tag)) throw Error("<" + e.tag + "> is not supported");
        std::istringstream in(known.at(e.tag));
        std::map<std::string, std::string> values;
        for (std::string s; in >> s;) {
            const std::size_t cut = s.find('=');
            values[s.substr(0, cut)] = cut == std::string::npos ? "" : s.substr(cut + 1);
        }
        for (const auto &[name, value] : e.attributes)
            if (!values.count(name) || (values[name] != "" && values[name] != value))
                throw Error("<" + e.tag + " " + name + "=\"" + value + "\"> is not supported");
        check(e, found);
    }
}

/* ---- what is exchanged ----------------------------------------------------------------------- */

class Wave { // a waveform that grows
  public:
    Wave(std::size_t n, int degree) : n_(static_cast<std::ptrdiff_t>(n)), degree_(degree)
    {
        grow(8);
    }
    Wave(Wave &&) = default; // w_ points into memory_, whose elements stay where they are
    void grow(int columns)
    {
        if (columns <= capacity_) return;
        wf *old = w_, *w;
        Numbers memory(wf_size(n_, degree_, 2 * columns) / sizeof(double) + 1);
        ok(wf_make(&w, n_, degree_, 2 * columns, memory.data(), memory.size() * sizeof(double)));
        if (old) ok(wf_copy(w, old));
        memory_.swap(memory);
        w_ = w, capacity_ = 2 * columns;
    }
    double *push(double t)
    {
        grow(columns() + 1);
        return wf_column(w_, ok(wf_push(w_, t, 0)));
    }
    void begin(const Numbers &t)
    {
        const int count = static_cast<int>(t.size());
        grow(count + 1);
        ok(wf_begin(w_, 0, count, t.data(), 0));
    }
    void copy(const Wave &from) { grow(from.columns()), ok(wf_copy(w_, from.w_)); }
    void read(double t, double *out) { ok(wf_read(w_, t, 0, out)); }
    void rollback() { ok(wf_rollback(w_)); }
    void advance() { ok(wf_advance(w_, 0)); }
    int columns() const { return wf_columns(w_); }
    double time(int j) const { return wf_time(w_, j); }
    double *column(int j) { return wf_column(w_, j); }
    Numbers last() { double *c = column(columns() - 1); return Numbers(c, c + n_); }

  private:
    std::ptrdiff_t n_;
    int degree_, capacity_ = 0;
    Numbers memory_;
    wf *w_ = nullptr;
};

using Map = std::vector<std::size_t>; // for each vertex of the target the one of the source

struct Exchange {
    std::string data, mesh, source;
    Participant *sender, *receiver;
    bool lagged, substeps; // lagged: the receiver does not wait, and reads `guess`
    std::size_t n, d;
    Map outward;
    Wave out, guess; // what the sender has written in this iteration; what is read in its place
    Numbers before, grid; // out at the window end, one iteration ago; relative times of x

    Wave &seen() { return lagged ? guess : out; }
};

inline double norm(const Numbers &a, const Numbers &b)
{
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); i++) sum += (a[i] - b[i]) * (a[i] - b[i]);
    return std::sqrt(sum);
}

/* ---- the coupling scheme --------------------------------------------------------------------- */

class Coupling {
  public:
    void hand_over(int me) // the other solver runs until it hands over
    {
        std::unique_lock<std::mutex> lock(mutex);
        if (alive[1 - me]) turn = 1 - me, condition.notify_all();
        condition.wait(lock, [&] { return turn == me; });
        if (!alive[1 - me] && ongoing())
            throw Error("the other solver has ended before the coupling");
    }
    void read(const std::string &file)
    {
        Reader reader(file);
        while (reader.read(root)) {}
        std::set<std::string> found;
        check(root, found);
        std::printf("precice.hpp: this is not preCICE, but a stand-in on waveform.h and iqn.h\n"
                    "precice.hpp: ignored:");
        for (const std::string &s : found) std::printf(" %s", s.c_str());
        std::printf("\n");
        scheme = root.one("coupling-scheme:");
        if (!scheme) throw Error("<coupling-scheme:...> is missing");
        serial = scheme->is("coupling-scheme:serial");
        implicit = scheme->tag.find("implicit") != std::string::npos;
        size = scheme->value("time-window-size", 0);
        max_time = scheme->value("max-time", 0);
        first = scheme->one("participants")->get("first");
    }
    bool ongoing() const { return !scheme || max_time - start > 1e-10 * size; }
    double end() const
    {
        const double t = (window + 1) * size;
        return t < max_time - 1e-10 * size ? t : max_time;
    }
    std::vector<const Element *> of(const std::string &tag, const std::string &participant,
                                    const std::string &data) const
    {
        std::vector<const Element *> found;
        for (const Element *p : root.all("participant"))
            if (p->tag == "participant" && p->get("name") == participant)
                for (const Element *e : p->all(tag))
                    if (e->get("name") == data) found.push_back(e);
        return found;
    }
    std::size_t dimensions(const std::string &mesh) const
    {
        for (const Element *m : root.all("mesh"))
            if (m->get("name") == mesh) return std::stoul(m->get("dimensions"));
        throw Error("no <mesh> " + mesh);
    }
    std::size_t dimensions(const std::string &mesh, const std::string &data) const
    {
        return describe(data)->tag == "data:vector" ? dimensions(mesh) : 1;
    }
    const Element *describe(const std::string &data) const
    {
        for (const Element *e : root.all("data:"))
            if (e->get("name") == data) return e;
        throw Error("no <data:...> " + data);
    }
    Map mapping(const std::string &source, const std::string &target) const;
    void prepare(); // both solvers have called initialize
    void judge();   // both solvers are at the window end: repeat the window, or go on

    std::mutex mutex;
    std::condition_variable condition;
    std::array<bool, 2> alive = {true, true};
    int turn = 0, ready = 0, window = 0, iteration = 0, failed = 0;
    double start = 0, size = 0, max_time = 0;
    bool repeat = false, serial = false, implicit = false;
    Element root;
    const Element *scheme = nullptr;
    std::string first;
    std::map<std::string, Participant *> members;
    std::map<std::string, Numbers> meshes; // coordinates of the vertices
    std::deque<Exchange> exchanges;
    std::vector<int> counts;

  private:
    Exchange &find(const Element *e)
    {
        for (Exchange &x : exchanges)
            if (x.mesh == e->get("mesh") && x.data == e->get(e->is("data") ? "name" : "data"))
                return x;
        throw Error("no <exchange> for <" + e->tag + ">");
    }
    void begin() // a constant first guess of what is read before it is written
    {
        for (Exchange &e : exchanges)
            if (e.lagged && ongoing()) e.guess.begin({end()});
    }
    bool converged();
    void accelerate(const Element *method, bool done);
    void make(const Element *method);

    Numbers memory_;
    iqn *q_ = nullptr;
};

inline Coupling *coupling = nullptr;
inline thread_local int seat = 0;

} // namespace impl

/* ---- the interface of preCICE ---------------------------------------------------------------- */

class Participant {
  public:
    Participant(string_view name, string_view file, int, int processes)
        : all_(impl::coupling), name_(name)
    {
        if (!all_) throw Error("both solvers run in one process: precice::run");
        if (processes != 1) throw Error("a solver of several processes is not supported");
        if (!all_->scheme) all_->read(std::string(file));
        all_->members[name_] = this;
        writing_ = all_->implicit;
    }
    Participant(const Participant &) = delete;
    void initialize()
    {
        const bool last = ++all_->ready == 2;
        if (last) all_->prepare();
        if (!last || name_ != all_->first) all_->hand_over(impl::seat);
    }
    void advance(double dt)
    {
        const double left = getMaxTimeStepSize() - dt, near = 1e-10 * all_->size;
        if (left < -near || dt <= 0) throw Error("advance: not a step inside the time window");
        time_ = left <= near ? all_->end() : time_ + dt;
        for (impl::Exchange &e : all_->exchanges)
            if (e.sender == this && (left <= near || e.substeps)) push(e, false);
        complete_ = reading_ = writing_ = false;
        if (left > near) return;
        if (name_ != all_->first) all_->judge();
        if (all_->ongoing()) all_->hand_over(impl::seat);
        time_ = all_->start, reading_ = all_->repeat, complete_ = !reading_;
        writing_ = complete_ && all_->implicit && isCouplingOngoing();
    }
    void finalize() {}

    int getMeshDimensions(string_view mesh) const
    {
        return static_cast<int>(all_->dimensions(std::string(mesh)));
    }
    int getDataDimensions(string_view mesh, string_view data) const
    {
        return static_cast<int>(all_->dimensions(std::string(mesh), std::string(data)));
    }
    double getMaxTimeStepSize() const { return isCouplingOngoing() ? all_->end() - time_ : 0; }
    bool isCouplingOngoing() const { return all_->ongoing(); }
    bool isTimeWindowComplete() const { return complete_; }
    bool requiresWritingCheckpoint() { return writing_; }
    bool requiresReadingCheckpoint() { return reading_; }
    bool requiresMeshConnectivityFor(string_view) const { return false; }
    bool requiresInitialData()
    {
        for (const impl::Element *e : all_->scheme->all("exchange"))
            if (e->get("from") == name_ && e->yes("initialize", "false")) return true;
        return false;
    }
    int getMeshVertexSize(string_view mesh) const
    {
        const std::string name(mesh);
        return static_cast<int>(all_->meshes[name].size() / all_->dimensions(name));
    }
    VertexID setMeshVertex(string_view mesh, span<const double> position)
    {
        impl::Numbers &all = all_->meshes[std::string(mesh)];
        all.insert(all.end(), position.data, position.data + position.size);
        return getMeshVertexSize(mesh) - 1;
    }
    void setMeshVertices(string_view mesh, span<const double> positions, span<VertexID> ids)
    {
        const std::size_t d = all_->dimensions(std::string(mesh));
        if (positions.size != d * ids.size) throw Error("setMeshVertices: sizes do not match");
        for (std::size_t i = 0; i < ids.size; i++)
            ids.data[i] = setMeshVertex(mesh, {positions.data + i * d, d});
    }
    void writeData(string_view mesh, string_view data, span<const VertexID> ids,
                   span<const double> values)
    {
        const impl::Key key{mesh, data};
        const std::size_t d = all_->dimensions(key.first, key.second);
        impl::Numbers &rows = writes_[key];
        rows.resize(d * static_cast<std::size_t>(getMeshVertexSize(mesh)));
        for (std::size_t i = 0; i < ids.size * d; i++)
            rows.at(static_cast<std::size_t>(ids.data[i / d]) * d + i % d) = values.data[i];
    }
    void readData(string_view mesh, string_view data, span<const VertexID> ids, double relative,
                  span<double> values) const
    {
        const auto found = reads_.find({std::string(mesh), std::string(data)});
        if (found == reads_.end()) throw Error("readData: " + name_ + " has no such data");
        if (!(relative >= 0 && relative <= getMaxTimeStepSize() + 1e-10 * all_->size))
            throw Error("readData: outside the time window");
        const auto &[e, inward] = found->second;
        impl::Numbers rows(e->n);
        e->seen().read(std::min(time_ + relative, std::max(time_, all_->end())), rows.data());
        for (std::size_t i = 0; i < ids.size * e->d; i++)
            values.data[i] = rows[inward.at(static_cast<std::size_t>(ids.data[i / e->d])) * e->d
                                  + i % e->d];
    }

  private:
    friend class impl::Coupling;
    void push(impl::Exchange &e, bool initial)
    {
        const auto found = writes_.find({e.source, e.data});
        double *column = e.out.push(time_);
        if (found == writes_.end()) {
            if (!initial) throw Error(name_ + " has not written " + e.data + " on " + e.source);
            std::fill(column, column + e.n, 0);
        } else {
            for (std::size_t i = 0; i < e.n; i++)
                column[i] = found->second[e.outward[i / e.d] * e.d + i % e.d];
            writes_.erase(found);
        }
        if (initial) std::copy(column, column + e.n, e.guess.push(time_)), e.before = e.out.last();
    }

    impl::Coupling *all_;
    std::string name_;
    double time_ = 0;
    bool complete_ = false, reading_ = false, writing_ = false;
    std::map<impl::Key, impl::Numbers> writes_;
    std::map<impl::Key, std::pair<impl::Exchange *, impl::Map>> reads_;
};

namespace impl {

inline Map Coupling::mapping(const std::string &source, const std::string &target) const
{
    const std::size_t d = dimensions(target);
    const Numbers &from = meshes.at(source), &to = meshes.at(target);
    bool found = source == target;
    for (const Element *m : root.all("mapping:nearest-neighbor"))
        found = found || (m->get("from") == source && m->get("to") == target);
    if (!found) throw Error("no <mapping:nearest-neighbor> from " + source + " to " + target);
    Map map;
    for (auto p = to.begin(); p != to.end(); p += static_cast<std::ptrdiff_t>(d)) {
        double least = std::numeric_limits<double>::infinity();
        map.push_back(0);
        for (std::size_t i = 0; i * d < from.size(); i++) {
            double distance = 0;
            for (std::size_t k = 0; k < d; k++) {
                const double s = from[i * d + k] - p[static_cast<std::ptrdiff_t>(k)];
                distance += s * s;
            }
            if (distance < least) least = distance, map.back() = i;
        }
    }
    return map;
}

inline void Coupling::prepare()
{
    for (const Element *e : scheme->all("exchange")) {
        const std::string data = e->get("data"), mesh = e->get("mesh"), from = e->get("from");
        const auto written = of("write-data", from, data);
        if (written.empty()) throw Error(from + " has no <write-data> for " + data);
        std::string source = written[0]->get("mesh");
        for (const Element *w : written)
            if (w->get("mesh") == mesh) source = mesh;
        const std::size_t d = dimensions(mesh, data);
        const std::size_t n = meshes[mesh].size() / dimensions(mesh) * d;
        const int degree = std::stoi(describe(data)->get("waveform-degree", "1"));
        exchanges.push_back({data, mesh, source, members.at(from), members.at(e->get("to")),
                             !(serial && from == first),
                             e->yes("substeps", implicit ? "true" : "false"), n, d,
                             mapping(source, mesh), {n, degree}, {n, degree}, {}, {}});
        Exchange &x = exchanges.back();
        for (const Element *r : of("read-data", e->get("to"), data))
            x.receiver->reads_[{r->get("mesh"), data}] = {&x, mapping(mesh, r->get("mesh"))};
        x.sender->push(x, true);
    }
    begin();
}

inline bool Coupling::converged()
{
    bool every = false;
    for (const Element &m : scheme->children) {
        if (m.tag.find("-measure") == std::string::npos) continue;
        Exchange &e = find(&m);
        const Numbers now = e.out.last();
        const double change = norm(now, e.lagged ? e.guess.last() : e.before);
        const double unit = m.is("relative") ? norm(now, Numbers(e.n)) : 1;
        if (!(change <= std::stod(m.get("limit")) * unit)) return false;
        every = true;
    }
    return every;
}

inline void Coupling::judge()
{
    const Element *method = scheme->one("acceleration:");
    const bool last = ++iteration >= scheme->value("max-iterations", 1e9), good = converged();
    const bool done = !implicit || good || last;
    failed += implicit && last && !good;
    if (method) accelerate(method, done);
    for (Exchange &e : exchanges) {
        e.before = e.out.last();
        if (e.lagged && (done || !method)) e.guess.copy(e.out); // accepted, not the next guess
        if (done) e.out.advance();
        if (done && e.lagged) e.guess.advance();
        e.out.rollback();
    }
    repeat = !done;
    if (!done) return;
    start = end();
    window++;
    counts.push_back(iteration);
    iteration = 0;
    begin();
}

/* A step of iqn.h.  Limits are ours: the last iteration takes a step as well, for its pair. */
inline void Coupling::accelerate(const Element *method, bool done)
{
    Numbers x, hx;
    for (Exchange &e : exchanges) {
        if (!e.lagged) continue;
        const double t0 = start, h = end() - start;
        if (iteration == 1) { // the guess on the sub-steps of x: those of the very first window
            Numbers t;
            for (int j = 1; j < e.out.columns(); j++) t.push_back(e.out.time(j));
            if (e.grid.empty())
                for (double s : t) e.grid.push_back((s - t0) / h);
            if (t.size() != e.grid.size()) {
                t.clear();
                for (double s : e.grid) t.push_back(t0 + s * h);
                t.back() = end();
            }
            e.guess.begin(t);
        }
        Numbers value(e.n);
        for (int j = 1; j < e.guess.columns(); j++) {
            x.insert(x.end(), e.guess.column(j), e.guess.column(j) + e.n);
            e.out.read(e.guess.time(j), value.data());
            hx.insert(hx.end(), value.begin(), value.end());
        }
    }
    if (!q_) make(method);
    ok(iqn_step(q_, x.data(), hx.data()));
    auto from = x.begin();
    for (Exchange &e : exchanges)
        if (e.lagged) {
            const std::ptrdiff_t count = length(e.grid) * static_cast<std::ptrdiff_t>(e.n);
            std::copy(from, from + count, e.guess.column(1));
            from += count;
        }
    if (done) ok(iqn_commit(q_));
}

inline void Coupling::make(const Element *method)
{
    const bool newton = method->is("acceleration:IQN"), imvj = method->is("acceleration:IQN-IMVJ");
    const bool reduced = newton && method->yes("reduced-time-grid", "true");
    std::set<const Exchange *> listed;
    for (const Element *e : method->all("data")) listed.insert(&find(e));
    std::vector<std::pair<std::size_t, double>> blocks; // length, weight
    std::size_t n = 0;
    for (const Exchange &e : exchanges) {
        const double weight = static_cast<double>(listed.count(&e));
        if (!e.lagged && weight > 0) throw Error("<" + method->tag + ">: <data> of the first one");
        if (!e.lagged) continue;
        const std::size_t front = reduced ? (e.grid.size() - 1) * e.n : 0;
        if (front > 0) blocks.push_back({front, 0});
        blocks.push_back({e.grid.size() * e.n - front, weight});
        n += e.grid.size() * e.n;
    }
    const int count = static_cast<int>(blocks.size());
    const int columns = static_cast<int>(method->value("max-used-iterations", imvj ? 20 : 100));
    const double omega = method->value("initial-relaxation", newton ? 0.1 : 0.5);
    const std::ptrdiff_t numbers = static_cast<std::ptrdiff_t>(n);
    memory_.resize(iqn_size(numbers, columns, count) / sizeof(double) + 1);
    ok(iqn_make(&q_, numbers, columns, count, memory_.data(), memory_.size() * sizeof(double)));
    const std::map<std::string, int> methods = {
        {"constant", IQN_CONSTANT}, {"aitken", IQN_AITKEN}, {"IQN-ILS", IQN_ILS},
        {"IQN-IMVJ", IQN_IMVJ}};
    const std::map<std::string, int> scalings = {
        {"constant", IQN_BY_WEIGHT}, {"value", IQN_BY_VALUE}, {"residual", IQN_BY_RESIDUAL},
        {"residual-sum", IQN_BY_RESIDUAL_SUM}};
    const Element *scaling = method->one("preconditioner");
    ok(iqn_set(q_, IQN_METHOD, methods.at(method->tag.substr(method->tag.find(':') + 1))));
    ok(iqn_set(q_, IQN_OMEGA, method->value("relaxation", omega)));
    ok(iqn_set(q_, IQN_PATIENCE, 0));
    if (newton) ok(iqn_set(q_, IQN_WINDOWS, method->value("time-windows-reused", imvj ? 0 : 10)));
    for (int b = 0; b < count; b++) {
        const auto &[block, weight] = blocks[static_cast<std::size_t>(b)];
        ok(iqn_set_block(q_, b, IQN_LENGTH, static_cast<double>(block)));
        ok(iqn_set_block(q_, b, IQN_WEIGHT, weight));
        ok(iqn_set_block(q_, b, IQN_SCALING, scalings.at(scaling ? scaling->get("type") : "value")));
    }
}

} // namespace impl

/* Run two functions, one solver each.  Returns the iterations of every window. */
inline std::vector<int> run(std::function<void()> first, std::function<void()> second)
{
    impl::Coupling both;
    std::exception_ptr failure;
    const auto solver = [&](int me, const std::function<void()> &solve) {
        impl::seat = me;
        try {
            std::unique_lock<std::mutex> lock(both.mutex);
            both.condition.wait(lock, [&] { return both.turn == me; });
            lock.unlock();
            if (!failure) solve();
        } catch (...) {
            if (!failure) failure = std::current_exception();
        }
        const std::lock_guard<std::mutex> lock(both.mutex);
        both.alive[static_cast<std::size_t>(me)] = false, both.turn = 1 - me;
        both.condition.notify_all();
    };
    impl::coupling = &both;
    std::thread a(solver, 0, std::cref(first)), b(solver, 1, std::cref(second));
    a.join();
    b.join();
    impl::coupling = nullptr;
    if (failure) std::rethrow_exception(failure);
    int total = 0;
    for (int count : both.counts) total += count;
    std::printf("precice.hpp: %d windows, %d iterations, %d windows ended by max-iterations\n",
                both.window, total, both.failed);
    return both.counts;
}

} // namespace precice

#ifdef PRECICE_MAIN
int first_main(int, char **);
int second_main(int, char **);
int main(int argc, char **argv)
try {
    int cut = 1;
    while (cut < argc && std::string(argv[cut]) != "--") cut++;
    const auto zero = [](int status) {
        if (status) throw precice::Error("a solver has ended with " + std::to_string(status));
    };
    precice::run([&] { zero(first_main(cut, argv)); },
                 [&] { zero(second_main(argc - cut, argv + cut)); });
} catch (const std::exception &e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
}
#endif
#endif
