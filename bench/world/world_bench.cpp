// SPDX-License-Identifier: MIT
#include "bench/world/world_bench.hpp"

#include <time.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <set>
#include <span>
#include <sstream>
#include <utility>

#include "base/file_io.hpp"
#include "base/statistics.hpp"
#include "base/text.hpp"
#include "base/try.hpp"
#include "geometry/vrml/vrml_shapes.hpp"

namespace burin::bench {
namespace {

namespace fs = std::filesystem;

double thread_time_s() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// Writes a bumpy patch of so many triangles, of a square grid's first ones.
std::string patch(unsigned triangles, unsigned seed) {
    const auto side = static_cast<unsigned>(std::ceil(std::sqrt(0.5 * triangles)));
    std::string text = "geometry IndexedFaceSet { coord Coordinate { point [\n";
    for (unsigned j = 0; j <= side; ++j)
        for (unsigned i = 0; i <= side; ++i)
            text += formatted("%.6f %.6f %.6f,\n", 0.001 * i,
                              0.0002 * std::sin(0.7 * i + 0.3 * seed) * std::cos(0.5 * j), 0.001 * j);
    text += "] } coordIndex [\n";
    unsigned written = 0;
    const auto face = [&](unsigned a, unsigned b, unsigned c) {
        if (written++ < triangles) text += formatted("%u, %u, %u, -1,\n", a, b, c);
    };
    for (unsigned j = 0; j < side; ++j)
        for (unsigned i = 0; i < side; ++i) {
            const unsigned a = j * (side + 1) + i, b = a + 1, c = a + side + 1, d = c + 1;
            face(a, c, b);
            face(b, c, d);
        }
    return text + "] }";
}

// A file that goes away again.
class PassingFile {
public:
    explicit PassingFile(fs::path path) : path_(std::move(path)) {}
    ~PassingFile() {
        std::error_code ignored;
        if (!path_.empty()) fs::remove(path_, ignored);
    }
    PassingFile(const PassingFile&) = delete;
    PassingFile& operator=(const PassingFile&) = delete;

private:
    fs::path path_;
};

// Puts a text into quotes for the shell.
std::string quoted_for_shell(const std::string& text) {
    std::string quoted = "'";
    for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return quoted + "'";
}

// What the other program has printed: its version, the triangles and the seconds.
struct CoinRun {
    std::string version;
    std::size_t triangles = 0;
    double seconds = 0.0;
};

Result<CoinRun> run_coin(const std::string& program, const std::string& world) {
    FILE* const pipe = popen((quoted_for_shell(program) + " " + quoted_for_shell(world) + " 2>/dev/null").c_str(), "r");
    if (pipe == nullptr) return fail(program, "cannot be run");
    std::string said;
    char part[256];
    while (std::fgets(part, sizeof part, pipe) != nullptr) said += part;
    const int status = pclose(pipe);
    CoinRun run;
    std::istringstream in(said);
    if (status == 0 && in >> run.version >> run.triangles >> run.seconds) return run;
    return fail(program, "does not read " + world);
}

Result<void> measure_ours(WorldBenchFigures& figures, const std::string& text, const std::string& name) {
    const double begin_s = thread_time_s();
    const Result<geometry::VrmlFile> file =
        geometry::read_vrml(text, name, geometry::vrml_files_beside(fs::path(name)));
    const double read_s = thread_time_s();
    if (!file) return std::unexpected(file.error());
    const geometry::VrmlWorldOrFaults world = geometry::shapes_of(*file);
    const double end_s = thread_time_s();
    if (!world) return std::unexpected(world.error().front());
    figures.read_s.push_back(read_s - begin_s);
    figures.shapes_s.push_back(end_s - read_s);
    figures.total_s.push_back(end_s - begin_s);
    std::set<std::string> names;
    for (const geometry::VrmlShape& shape : world->shapes) names.insert(shape.name);
    figures.names = names.size();
    figures.nodes = world->nodes;
    figures.triangles = world->triangles;
    return {};
}

std::string milliseconds(const std::vector<double>& seconds) {
    return formatted("%8.1f ms %8.1f ms", 1e3 * least(seconds), 1e3 * median(seconds));
}

Json times_json(const std::vector<double>& seconds) {
    return {{"least_s", least(seconds)}, {"median_s", median(seconds)}, {"most_s", most(seconds)}};
}

}  // namespace

std::string made_world(unsigned objects, unsigned triangles_each) {
    std::string text = "#VRML V2.0 utf8\n";
    for (unsigned i = 0; i < objects; ++i) {
        text += formatted("DEF Part%u Transform { translation %.3f %.3f %.3f rotation 0 1 0 %.4f children Shape {\n", i,
                          0.05 * (i % 10), 0.05 * (i / 10 % 10), 0.05 * (i / 100), 0.01 * i);
        text += formatted("appearance Appearance { material Material { diffuseColor %.3f %.3f 0.5 } }\n",
                          0.1 * (i % 10), 0.1 * (i / 10 % 10));
        text += patch(triangles_each, i) + " } }\n";
    }
    return text;
}

std::string coin_reader_beside_burin() {
    std::error_code code;
    const fs::path program = fs::read_symlink("/proc/self/exe", code).parent_path() / "burin-coin-reader";
    return !code && fs::exists(program, code) ? program.string() : "";
}

Result<WorldBenchFigures> measure_world(const WorldBenchTask& task) {
    WorldBenchFigures figures;
    figures.runs = task.runs;
    std::string text, path = task.world;
    const bool is_made = task.world.empty();
    if (is_made) {
        text = made_world(task.objects, task.triangles_each);
        path = (fs::path(task.folder) / "burin-bench-world.wrl").string();
        const auto bytes = std::as_bytes(std::span(text.data(), text.size()));
        BURIN_TRY_DO(write_file_atomically(path, bytes));
    } else {
        BURIN_TRY(read, read_text_file(path, geometry::kMostVrmlBytes));
        text = std::move(read);
    }
    const PassingFile passing(is_made ? fs::path(path) : fs::path());
    figures.world = is_made ? formatted("made: %u objects of %u triangles", task.objects, task.triangles_each) : path;
    figures.bytes = text.size();
    if (task.coin.empty())
        figures.without_coin = "Coin is not installed (libcoin-dev), or was not when burin was built";
    for (unsigned run = 0; run < task.runs; ++run) {
        BURIN_TRY_DO(measure_ours(figures, text, path));
        if (task.coin.empty() || !figures.without_coin.empty()) continue;
        const Result<CoinRun> coin = run_coin(task.coin, path);
        if (!coin) {
            figures.without_coin = coin.error().line();
            figures.coin.reset();
            continue;
        }
        if (!figures.coin) figures.coin.emplace();
        figures.coin->version = coin->version;
        figures.coin->triangles = coin->triangles;
        figures.coin->total_s.push_back(coin->seconds);
    }
    return figures;
}

std::string world_bench_table(const WorldBenchFigures& f) {
    std::string table = formatted("%s\n", f.world.c_str());
    table += formatted("%zu bytes, %zu nodes, %zu names, %zu triangles, %u runs of one thread's time\n\n", f.bytes,
                       f.nodes, f.names, f.triangles, f.runs);
    table += "                             least      median\n";
    table += "  burin, text to tree    " + milliseconds(f.read_s) + "\n";
    table += "  burin, to triangles    " + milliseconds(f.shapes_s) + "\n";
    table += "  burin, both            " + milliseconds(f.total_s) + "\n";
    if (f.coin) {
        table += formatted("  Coin %-8s          ", f.coin->version.c_str()) + milliseconds(f.coin->total_s) +
                 formatted("   %zu triangles\n", f.coin->triangles);
        table += formatted("  Coin takes %.2f times as long\n", median(f.coin->total_s) / median(f.total_s));
    } else {
        table += "  no time of Coin: " + f.without_coin + "\n";
    }
    return table;
}

Json world_bench_json(const WorldBenchFigures& f) {
    Json json{{"bench", "world"}, {"world", f.world},         {"bytes", f.bytes}, {"nodes", f.nodes},
              {"names", f.names}, {"triangles", f.triangles}, {"runs", f.runs}};
    json["burin"] = {
        {"tree", times_json(f.read_s)}, {"triangles", times_json(f.shapes_s)}, {"total", times_json(f.total_s)}};
    if (f.coin) {
        json["coin"] = {
            {"version", f.coin->version}, {"triangles", f.coin->triangles}, {"total", times_json(f.coin->total_s)}};
        json["coin_over_burin"] = median(f.coin->total_s) / median(f.total_s);
    } else {
        json["coin"] = Json();
        json["without_coin"] = f.without_coin;
    }
    return json;
}

}  // namespace burin::bench
