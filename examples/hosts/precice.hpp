/* SPDX-License-Identifier: MIT

   precice.hpp - this is not preCICE: a stand-in that runs two solvers written for it in one process

   The same as precice.py, for C++17: waveform.h interpolates, iqn.h accelerates.  In a folder named
   precice, so that solvers find <precice/precice.hpp>:

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
#include <mutex>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

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

namespace impl {

using Numbers = std::vector<double>;
using Map = std::vector<std::size_t>; // for each vertex of a mesh one of another mesh
using std::string;
using Key = std::pair<string, string>; // mesh, data

inline int ok(int status)
{
    if (status < 0) throw Error(status > -200 ? wf_message(status) : iqn_message(status));
    return status;
}

inline std::ptrdiff_t whole(std::size_t n) { return static_cast<std::ptrdiff_t>(n); }
inline int number(std::size_t n) { return static_cast<int>(n); }
inline std::size_t index(int n) { return static_cast<std::size_t>(n); }

/* ---- the configuration ----------------------------------------------------------------------- */

struct Element {
    string tag;
    std::map<string, string> attributes;
    std::deque<Element> children;

    string get(const string &name, const string &otherwise = "") const
    {
        const auto found = attributes.find(name);
        return found == attributes.end() ? otherwise : found->second;
    }
    bool yes(const string &name, const string &otherwise) const
    {
        return std::set<string>{"1", "true", "True", "yes", "on"}.count(get(name, otherwise)) > 0;
    }
    bool is(const string &prefix) const { return tag.compare(0, prefix.size(), prefix) == 0; }
    std::vector<const Element *> all(const string &prefix, const string &name = "") const
    {
        std::vector<const Element *> found;
        for (const Element &e : children)
            if (e.is(prefix) && (name.empty() || e.get("name") == name)) found.push_back(&e);
        return found;
    }
    const Element *one(const string &prefix, const string &name = "") const
    {
        const auto found = all(prefix, name);
        if (found.size() > 1) throw Error("more than one <" + prefix + "> is not supported");
        return found.empty() ? nullptr : found[0];
    }
    const Element &need(const string &prefix, const string &name = "") const
    {
        if (const Element *e = one(prefix, name)) return *e;
        throw Error("<" + prefix + "> " + name + " is missing");
    }
    double value(const string &name, double otherwise) const
    {
        const Element *e = one(name);
        return e ? std::stod(e->get("value")) : otherwise;
    }
};

class Reader { // tags and attributes of XML; text and comments are passed over
  public:
    explicit Reader(const string &file)
    {
        std::ifstream in(file);
        if (!in) throw Error("cannot read " + file);
        text_.assign(std::istreambuf_iterator<char>(in), {});
    }
    bool read(Element &parent) // the next child, or false behind the last one
    {
        Element e;
        for (;;) {
            at_ = text_.find('<', at_);
            if (at_ == string::npos) return false;
            if (text_.compare(at_, 4, "<!--") == 0) skip("-->");
            else if (text_[at_ + 1] == '?' || text_[at_ + 1] == '!') skip(">");
            else break;
        }
        if (text_[at_ + 1] == '/') return skip(">"), false;
        at_++;
        e.tag = word(" \t\r\n/>");
        for (space(); text_.at(at_) != '>' && text_.at(at_) != '/'; space()) {
            const string name = word(" \t\r\n=");
            at_ = text_.find_first_of("\"'", at_);
            const string quote(1, text_.at(at_++));
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
    void skip(const string &end) { at_ = std::min(text_.find(end, at_), text_.size() - 1) + 1; }
    void space() { at_ = text_.find_first_not_of(" \t\r\n", at_); }
    string word(const string &ends)
    {
        const std::size_t from = at_;
        at_ = std::min(text_.find_first_of(ends, at_), text_.size());
        return text_.substr(from, at_ - from);
    }
    string text_;
    std::size_t at_ = 0;
};

/* Elements and their attributes; NAME=VALUE: no other value is supported, NAME=: no effect. */
inline const string measure = "limit data mesh suffices=false strict=false";
inline const string newton = "reduced-time-grid on-bound-violation=ignore always-build-jacobian=";
inline const std::map<string, string> known = {
    {"precice-configuration", "experimental= wait-in-finalize="}, {"participant", "name"},
    {"data:scalar", "name waveform-degree"}, {"data:vector", "name waveform-degree"},
    {"mesh", "name dimensions"}, {"use-data", "name"}, {"provide-mesh", "name"},
    {"receive-mesh", "name from api-access=false geometric-filter= safety-factor="},
    {"write-data", "name mesh"}, {"read-data", "name mesh"},
    {"mapping:nearest-neighbor", "direction from to constraint=consistent"},
    {"coupling-scheme:serial-explicit", ""}, {"coupling-scheme:parallel-explicit", ""},
    {"coupling-scheme:serial-implicit", ""}, {"coupling-scheme:parallel-implicit", ""},
    {"participants", "first second"}, {"exchange", "data mesh from to initialize substeps"},
    {"max-time", "value"}, {"time-window-size", "value method=fixed"}, {"max-iterations", "value"},
    {"absolute-convergence-measure", measure}, {"relative-convergence-measure", measure},
    {"acceleration:constant", ""}, {"acceleration:aitken", ""}, {"acceleration:IQN-ILS", newton},
    {"acceleration:IQN-IMVJ", newton}, {"data", "name mesh"}, {"relaxation", "value"},
    {"initial-relaxation", "value enforce=false"}, {"max-used-iterations", "value"},
    {"time-windows-reused", "value"},
    {"preconditioner", "type update-on-threshold= freeze-after=-1"}};
inline const std::set<string> ignored = {
    "log", "m2n", "intra-comm", "profiling", "export", "watch-point", "watch-integral", "filter",
    "imvj-restart-mode"};

inline void check(const Element &parent, std::set<string> &found)
{
    for (const Element &e : parent.children) {
        if (ignored.count(e.tag.substr(0, e.tag.find(':')))) {
            found.insert("<" + e.tag + ">");
            continue;
        }
        if (!known.count(e.tag)) throw Error("<" + e.tag + "> is not supported");
        std::istringstream in(known.at(e.tag));
        std::map<string, string> values;
        for (string s; in >> s;) {
            const std::size_t cut = std::min(s.find('='), s.size());
            values[s.substr(0, cut)] = s.substr(std::min(cut + 1, s.size()));
        }
        for (const auto &[name, value] : e.attributes)
            if (!values.count(name) || (values[name] != "" && values[name] != value))
                throw Error("<" + e.tag + " " + name + "=\"" + value + "\"> is not supported");
        check(e, found);
    }
}

/* ---- what is exchanged ----------------------------------------------------------------------- */

struct Wave { // a waveform that grows; w points into memory, whose elements stay where they are
    Wave(std::size_t count, int p) : n(whole(count)), degree(p) { grow(8); }
    Wave(Wave &&) = default;
    void grow(int columns)
    {
        if (columns <= capacity) return;
        wf *larger = nullptr;
        capacity = 2 * columns;
        Numbers more(wf_size(n, degree, capacity) / sizeof(double) + 1);
        ok(wf_make(&larger, n, degree, capacity, more.data(), more.size() * sizeof(double)));
        if (w) ok(wf_copy(larger, w));
        memory.swap(more), w = larger;
    }
    double *push(double t)
    {
        grow(wf_columns(w) + 1);
        return wf_column(w, ok(wf_push(w, t, 0)));
    }
    void begin(const Numbers &t)
    {
        grow(number(t.size()) + 1);
        ok(wf_begin(w, 0, number(t.size()), t.data(), 0));
    }
    Numbers read(double t) const
    {
        Numbers value(static_cast<std::size_t>(n));
        ok(wf_read(w, t, 0, value.data()));
        return value;
    }
    Numbers last() const { return read(wf_time(w, wf_columns(w) - 1)); }

    std::ptrdiff_t n;
    int degree, capacity = 0;
    Numbers memory;
    wf *w = nullptr;
};

struct Exchange;

struct Member { // a participant
    std::map<Key, Numbers> writes; // since the last advance
    std::map<Key, std::pair<Exchange *, Map>> reads;
};

struct Exchange { // `out` is what its sender has written; `guess` is read in its place where the
    string data, mesh, source; // receiver does not wait for the sender: it lags behind
    Member *sender;
    bool lagged, substeps;
    std::size_t n, d;
    Map outward;
    Wave out, guess;
    Numbers before, grid; // out at the window end, one iteration ago; relative times of x

    Wave &seen() { return lagged ? guess : out; }
    void push(double t, bool initial)
    {
        const auto found = sender->writes.find({source, data});
        const bool written = found != sender->writes.end();
        if (!written && !initial) throw Error(data + " has not been written on " + source);
        Numbers value(n);
        for (std::size_t i = 0; written && i < n; i++)
            value[i] = found->second[outward[i / d] * d + i % d];
        if (written) sender->writes.erase(found);
        std::copy(value.begin(), value.end(), out.push(t));
        if (initial) std::copy(value.begin(), value.end(), guess.push(t)), before = value;
    }
};

inline double norm(const Numbers &a, const Numbers &b)
{
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); i++) sum += (a[i] - b[i]) * (a[i] - b[i]);
    return std::sqrt(sum);
}

/* ---- the coupling scheme --------------------------------------------------------------------- */

struct Coupling {
    Exchange &find(const string &mesh, const string &data)
    {
        for (Exchange &x : exchanges)
            if (x.mesh == mesh && x.data == data) return x;
        throw Error("no <exchange> of " + data + " on " + mesh);
    }
    bool ongoing() const { return !scheme || max_time - start > 1e-10 * size; }
    double end() const
    {
        const double t = (static_cast<double>(counts.size()) + 1) * size;
        return t < max_time - 1e-10 * size ? t : max_time;
    }
    std::size_t dimensions(const string &mesh) const
    {
        return std::stoul(root->need("mesh", mesh).get("dimensions"));
    }
    std::size_t dimensions(const string &mesh, const string &data) const
    {
        return root->need("data:", data).tag == "data:vector" ? dimensions(mesh) : 1;
    }
    std::size_t vertices(const string &mesh) { return meshes[mesh].size() / dimensions(mesh); }
    void hand_over(std::size_t me)
    {
        std::unique_lock<std::mutex> lock(mutex);
        if (alive[1 - me]) turn = 1 - me, condition.notify_all();
        condition.wait(lock, [&] { return turn == me; });
        if (!alive[1 - me] && ongoing()) throw Error("the other solver has ended too early");
    }
    void read(const string &file)
    {
        Reader reader(file);
        std::set<string> found;
        while (reader.read(file_)) {}
        check(file_, found);
        std::printf("precice.hpp: this is not preCICE, but a stand-in on waveform.h and iqn.h\n"
                    "precice.hpp: ignored:");
        for (const string &s : found) std::printf(" %s", s.c_str());
        std::printf("\n");
        root = &file_.need("precice-configuration");
        scheme = &root->need("coupling-scheme:");
        serial = scheme->is("coupling-scheme:serial");
        implicit = scheme->tag.find("implicit") != string::npos;
        size = std::stod(scheme->need("time-window-size").get("value"));
        max_time = std::stod(scheme->need("max-time").get("value"));
        first = scheme->need("participants").get("first");
    }
    Map mapping(const string &source, const string &target) const
    {
        const std::size_t d = dimensions(target);
        const Numbers &from = meshes.at(source), &to = meshes.at(target);
        bool found = source == target;
        for (const Element *p : root->all("participant"))
            for (const Element *m : p->all("mapping:"))
                found = found || (m->get("from") == source && m->get("to") == target);
        if (!found) throw Error("no <mapping:nearest-neighbor> from " + source + " to " + target);
        Map map(to.size() / d);
        for (std::size_t j = 0; j < map.size(); j++) {
            double least = std::numeric_limits<double>::infinity();
            for (std::size_t i = 0; i * d < from.size(); i++) {
                double square = 0;
                for (std::size_t k = 0; k < d; k++)
                    square += (from[i * d + k] - to[j * d + k]) * (from[i * d + k] - to[j * d + k]);
                if (square < least) least = square, map[j] = i;
            }
        }
        return map;
    }
    void prepare()
    {
        for (const Element *e : scheme->all("exchange")) {
            const string data = e->get("data"), mesh = e->get("mesh"), from = e->get("from");
            const auto written = root->need("participant", from).all("write-data", data);
            if (written.empty()) throw Error(from + " has no <write-data> for " + data);
            string source = written[0]->get("mesh");
            for (const Element *w : written)
                if (w->get("mesh") == mesh) source = mesh;
            const std::size_t d = dimensions(mesh, data), n = vertices(mesh) * d;
            const int degree = std::stoi(root->need("data:", data).get("waveform-degree", "1"));
            const bool lagged = !(serial && from == first);
            exchanges.push_back({data, mesh, source, &members[from], lagged,
                                 e->yes("substeps", implicit ? "true" : "false"), n, d,
                                 mapping(source, mesh), {n, degree}, {n, degree}, {}, {}});
            for (const Element *r : root->need("participant", e->get("to")).all("read-data", data))
                members[e->get("to")].reads[{r->get("mesh"), data}] = {
                    &exchanges.back(), mapping(mesh, r->get("mesh"))};
            exchanges.back().push(0, true);
        }
    }
    bool converged()
    {
        bool every = false;
        for (const Element &m : scheme->children) {
            if (m.tag.find("-measure") == string::npos) continue;
            const Exchange &e = find(m.get("mesh"), m.get("data"));
            const Numbers now = e.out.last();
            const double change = norm(now, e.lagged ? e.guess.last() : e.before);
            const double unit = m.is("relative") ? norm(now, Numbers(e.n)) : 1;
            if (!(change <= std::stod(m.get("limit")) * unit)) return false;
            every = true;
        }
        return every;
    }
    void judge()
    {
        const Element *method = scheme->one("acceleration:");
        const bool last = ++iteration >= scheme->value("max-iterations", 1e9), good = converged();
        repeat = implicit && !good && !last;
        failed += implicit && last && !good;
        if (method) accelerate(*method, !repeat);
        for (Exchange &e : exchanges) {
            e.before = e.out.last();
            if (e.lagged && (!repeat || !method)) { // what was written, not the next guess
                e.guess.grow(wf_columns(e.out.w));
                ok(wf_copy(e.guess.w, e.out.w));
            }
            if (!repeat) ok(wf_advance(e.out.w, 0));
            if (!repeat && e.lagged) ok(wf_advance(e.guess.w, 0));
            ok(wf_rollback(e.out.w));
        }
        if (repeat) return;
        start = end();
        counts.push_back(iteration);
        iteration = 0;
    }
    /* A step of iqn.h, without limits: the last iteration takes one as well, for its pair.  In the
       first iteration of a window x is the constant guess, on the sub-steps of the first one. */
    void accelerate(const Element &method, bool done)
    {
        Numbers x, hx;
        for (Exchange &e : exchanges) {
            if (!e.lagged) continue;
            const double h = end() - start;
            if (iteration == 1) {
                Numbers t;
                for (int j = 1; j < wf_columns(e.out.w); j++) t.push_back(wf_time(e.out.w, j));
                for (std::size_t j = e.grid.size(); counts.empty() && j < t.size(); j++)
                    e.grid.push_back((t[j] - start) / h);
                if (t.size() != e.grid.size()) {
                    t.clear();
                    for (double s : e.grid) t.push_back(start + s * h);
                    t.back() = end();
                }
                e.guess.begin(t);
            }
            for (int j = 1; j < wf_columns(e.guess.w); j++) {
                const double *now = wf_column(e.guess.w, j);
                const Numbers next = e.out.read(wf_time(e.guess.w, j));
                x.insert(x.end(), now, now + e.n);
                hx.insert(hx.end(), next.begin(), next.end());
            }
        }
        if (!q) make(method);
        ok(iqn_step(q, x.data(), hx.data()));
        if (done) ok(iqn_commit(q));
        auto from = x.begin();
        for (Exchange &e : exchanges)
            if (e.lagged) {
                const auto to = from + whole(e.grid.size() * e.n);
                std::copy(from, to, wf_column(e.guess.w, 1));
                from = to;
            }
    }
    void make(const Element &method)
    {
        const bool qn = method.is("acceleration:IQN"), imvj = method.is("acceleration:IQN-IMVJ");
        const bool reduced = qn && method.yes("reduced-time-grid", "true");
        std::set<const Exchange *> listed;
        for (const Element *e : method.all("data"))
            listed.insert(&find(e->get("mesh"), e->get("name")));
        std::vector<std::pair<std::size_t, double>> blocks; // length, weight
        std::size_t n = 0;
        for (const Exchange &e : exchanges) {
            const double weight = static_cast<double>(listed.count(&e));
            if (!e.lagged && weight > 0) throw Error("<" + method.tag + ">: data of the first");
            if (!e.lagged) continue;
            const std::size_t front = reduced ? (e.grid.size() - 1) * e.n : 0;
            if (front > 0) blocks.push_back({front, 0});
            blocks.push_back({e.grid.size() * e.n - front, weight});
            n += e.grid.size() * e.n;
        }
        const int count = number(blocks.size());
        const int columns = static_cast<int>(method.value("max-used-iterations", 100));
        memory.resize(iqn_size(whole(n), columns, count) / sizeof(double) + 1);
        ok(iqn_make(&q, whole(n), columns, count, memory.data(), memory.size() * sizeof(double)));
        const std::map<string, int> word = {
            {"constant", IQN_CONSTANT}, {"aitken", IQN_AITKEN}, {"IQN-ILS", IQN_ILS},
            {"IQN-IMVJ", IQN_IMVJ}, {"by constant", IQN_BY_WEIGHT}, {"by value", IQN_BY_VALUE},
            {"by residual", IQN_BY_RESIDUAL}, {"by residual-sum", IQN_BY_RESIDUAL_SUM}};
        const Element *scaling = method.one("preconditioner");
        const string size_of = "by " + (scaling ? scaling->get("type") : "value");
        if (!word.count(size_of)) throw Error("<preconditioner type> " + size_of);
        const double omega = method.value("initial-relaxation", qn ? 0.1 : 0.5);
        ok(iqn_set(q, IQN_METHOD, word.at(method.tag.substr(method.tag.find(':') + 1))));
        ok(iqn_set(q, IQN_OMEGA, method.value("relaxation", omega)));
        ok(iqn_set(q, IQN_PATIENCE, 0));
        if (qn) ok(iqn_set(q, IQN_WINDOWS, method.value("time-windows-reused", imvj ? 0 : 10)));
        for (int b = 0; b < count; b++) {
            const auto &[block, weight] = blocks[index(b)];
            ok(iqn_set_block(q, b, IQN_LENGTH, static_cast<double>(block)));
            ok(iqn_set_block(q, b, IQN_WEIGHT, weight));
            ok(iqn_set_block(q, b, IQN_SCALING, word.at(size_of)));
        }
    }

    std::mutex mutex;
    std::condition_variable condition;
    std::array<bool, 2> alive = {true, true};
    std::size_t turn = 0;
    int ready = 0, iteration = 0, failed = 0;
    double start = 0, size = 0, max_time = 0;
    bool repeat = false, serial = false, implicit = false;
    Element file_;
    const Element *root = nullptr, *scheme = nullptr;
    string first;
    std::map<string, Member> members;
    std::map<string, Numbers> meshes; // coordinates of the vertices
    std::deque<Exchange> exchanges;
    std::vector<int> counts; // iterations
    Numbers memory;
    iqn *q = nullptr;
};

inline Coupling *coupling = nullptr;
inline thread_local std::size_t seat = 0;

} // namespace impl

/* ---- the interface of preCICE ---------------------------------------------------------------- */

class Participant {
  public:
    Participant(string_view name, string_view file, int, int processes, void * = nullptr)
        : all_(impl::coupling), name_(name)
    {
        if (!all_) throw Error("both solvers run in one process: precice::run");
        if (processes != 1) throw Error("a solver of several processes is not supported");
        if (!all_->scheme) all_->read(std::string(file));
        mine_ = &all_->members[name_];
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
            if (e.sender == mine_ && (left <= near || e.substeps)) e.push(time_, false);
        complete_ = reading_ = writing_ = false;
        if (left > near) return;
        if (name_ != all_->first) all_->judge();
        if (all_->ongoing()) all_->hand_over(impl::seat);
        time_ = all_->start, reading_ = all_->repeat, complete_ = !reading_;
        writing_ = complete_ && all_->implicit && isCouplingOngoing();
    }
    void finalize() {}
    template <class... T> void setMeshEdges(const T &...) {} // nearest-neighbor reads no
    template <class... T> void setMeshTriangles(const T &...) {} // connectivity
    template <class... T> void setMeshQuads(const T &...) {}
    template <class... T> void setMeshTetrahedra(const T &...) {}
    void startProfilingSection(string_view) {}
    void stopLastProfilingSection() {}

    int getMeshDimensions(string_view mesh) const
    {
        return impl::number(all_->dimensions(std::string(mesh)));
    }
    int getDataDimensions(string_view mesh, string_view data) const
    {
        return impl::number(all_->dimensions(std::string(mesh), std::string(data)));
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
        return impl::number(all_->vertices(std::string(mesh)));
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
        const std::string m(mesh), name(data);
        const std::size_t d = all_->dimensions(m, name);
        impl::Numbers &rows = mine_->writes[{m, name}];
        rows.resize(d * all_->vertices(m));
        for (std::size_t i = 0; i < ids.size * d; i++)
            rows.at(impl::index(ids.data[i / d]) * d + i % d) = values.data[i];
    }
    void readData(string_view mesh, string_view data, span<const VertexID> ids, double relative,
                  span<double> values) const
    {
        const auto found = mine_->reads.find({std::string(mesh), std::string(data)});
        if (found == mine_->reads.end()) throw Error("readData: " + name_ + " has no such data");
        if (!(relative >= 0 && relative <= getMaxTimeStepSize() + 1e-10 * all_->size))
            throw Error("readData: outside the time window");
        const auto &[e, inward] = found->second;
        const double t = std::min(time_ + relative, std::max(time_, all_->end()));
        const impl::Numbers rows = e->seen().read(t);
        for (std::size_t i = 0; i < ids.size * e->d; i++) {
            const std::size_t vertex = inward.at(impl::index(ids.data[i / e->d]));
            values.data[i] = rows[vertex * e->d + i % e->d];
        }
    }

  private:
    impl::Coupling *all_;
    impl::Member *mine_;
    std::string name_;
    double time_ = 0;
    bool complete_ = false, reading_ = false, writing_ = false;
};

/* Run two functions, one solver each.  Returns the iterations of every window. */
inline std::vector<int> run(std::function<void()> first, std::function<void()> second)
{
    impl::Coupling both;
    std::exception_ptr failure;
    const auto solver = [&](std::size_t me, const std::function<void()> &solve) {
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
        both.alive[me] = false, both.turn = 1 - me;
        both.condition.notify_all();
    };
    impl::coupling = &both;
    std::thread a(solver, 0, std::cref(first)), b(solver, 1, std::cref(second));
    a.join(), b.join();
    impl::coupling = nullptr;
    if (failure) std::rethrow_exception(failure);
    int total = 0;
    for (int count : both.counts) total += count;
    std::printf("precice.hpp: %d windows, %d iterations, %d windows ended by max-iterations\n",
                impl::number(both.counts.size()), total, both.failed);
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
