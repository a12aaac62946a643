// SPDX-License-Identifier: MIT
// bench_stroke [--json] [--csv FILE] [--threads N] [--largest N]
// Carves the scenes that the accuracy tests use (tests/compute/carve_scenes.hpp) out of a unit cube, sweep by sweep, each
// followed by re-meshing what changed, at N = 64, 128, 256; prints errors against the closed form, the time of an update
// (median and p99, wall), what an update touched, and the memory. Times are of this machine; errors are of the method.
#include <algorithm>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

#include "base/clock.hpp"
#include "tests/compute/carve_scenes.hpp"

namespace burin {
namespace {

struct Row {
    std::string scene;
    int resolution = 0;
    test::CarveErrors errors;
    double h_m = 0.0, median_ms = 0.0, p99_ms = 0.0, rays_touched = 0.0, rays_changed = 0.0, triangles = 0.0;
    double bytes_a_ray = 0.0;
    std::uint64_t rays_held = 0, triangles_held = 0, disagreeing_edges = 0;
};

// The value below which the given share of the sorted values lies.
double quantile(const std::vector<double>& sorted, double share) {
    return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1) + 0.5)];
}

Row carve(const test::CarveScene& scene, int resolution, WorkerPool& pool) {
    MonotonicClock clock;
    Solid cube = *make_block(Vec3(1.0), resolution, {"cube", {200, 200, 200}});
    Surface surface(cube.lattice);
    const auto engine = make_cpu_engine(std::move(cube), pool);
    surface.remesh(engine->solid(), engine->dirty_tiles().take(), pool);
    Row row;
    row.scene = scene.name;
    row.resolution = resolution;
    row.h_m = surface.lattice().spacing_m;
    std::vector<double> times_ms;
    for (const BallSweep& sweep : scene.sweeps) {
        const Nanoseconds start = clock.now_ns();
        const auto stats = engine->cut(std::span(&sweep, 1));
        const RemeshStats meshed = surface.remesh(engine->solid(), engine->dirty_tiles().take(), pool);
        times_ms.push_back(1e3 * seconds(clock.now_ns() - start));
        const double share = 1.0 / static_cast<double>(scene.sweeps.size());
        row.rays_touched += share * static_cast<double>(stats->rays_touched);
        row.rays_changed += share * static_cast<double>(stats->rays_changed);
        row.triangles += share * static_cast<double>(meshed.triangles);
    }
    std::ranges::sort(times_ms);
    row.median_ms = quantile(times_ms, 0.5);
    row.p99_ms = quantile(times_ms, 0.99);
    row.errors = measure(surface, scene);
    row.rays_held = engine->solid().rays_held();
    row.bytes_a_ray = static_cast<double>(engine->solid().bytes()) / static_cast<double>(row.rays_held);
    row.triangles_held = surface.triangles();
    row.disagreeing_edges = surface.disagreeing_edges();
    return row;
}

struct Column {
    const char* name;
    double (*value)(const Row&);
};

constexpr Column kColumns[] = {
    {"volume_error_of_removed", [](const Row& r) { return r.errors.volume; }},
    {"surface_rms_m", [](const Row& r) { return r.errors.surface_rms_m; }},
    {"surface_rms_h", [](const Row& r) { return r.errors.surface_rms_m / r.h_m; }},
    {"surface_max_m", [](const Row& r) { return r.errors.surface_max_m; }},
    {"surface_max_h", [](const Row& r) { return r.errors.surface_max_m / r.h_m; }},
    {"edge_max_h", [](const Row& r) { return r.errors.edge_max_m / r.h_m; }},
    {"corner_max_h", [](const Row& r) { return r.errors.corner_max_m / r.h_m; }},
    {"update_median_ms", [](const Row& r) { return r.median_ms; }},
    {"update_p99_ms", [](const Row& r) { return r.p99_ms; }},
    {"rays_touched_an_update", [](const Row& r) { return r.rays_touched; }},
    {"rays_changed_an_update", [](const Row& r) { return r.rays_changed; }},
    {"rays_held", [](const Row& r) { return static_cast<double>(r.rays_held); }},
    {"bytes_a_ray", [](const Row& r) { return r.bytes_a_ray; }},
    {"triangles_an_update", [](const Row& r) { return r.triangles; }},
    {"triangles_held", [](const Row& r) { return static_cast<double>(r.triangles_held); }},
    {"disagreeing_edges", [](const Row& r) { return static_cast<double>(r.disagreeing_edges); }},
};

std::string number(double x) {
    char text[32];
    return {text, std::to_chars(text, text + sizeof text, x, std::chars_format::general, 5).ptr};
}

std::string csv(const std::vector<Row>& rows, unsigned threads) {
    std::string text = "scene,resolution,threads";
    for (const Column& c : kColumns) text += std::string(",") + c.name;
    text += '\n';
    for (const Row& r : rows) {
        text += r.scene + ',' + std::to_string(r.resolution) + ',' + std::to_string(threads);
        for (const Column& c : kColumns) text += ',' + number(c.value(r));
        text += '\n';
    }
    return text;
}

std::string json(const std::vector<Row>& rows, unsigned threads) {
    std::string text = "[";
    for (const Row& r : rows) {
        text += (text.size() > 1 ? ",\n " : "") + std::string("{\"scene\": \"") + r.scene +
                "\", \"resolution\": " + std::to_string(r.resolution) + ", \"threads\": " + std::to_string(threads);
        for (const Column& c : kColumns) text += std::string(", \"") + c.name + "\": " + number(c.value(r));
        text += "}";
    }
    return text + "]\n";
}

void print_table(const std::vector<Row>& rows) {
    std::printf("%-12s %4s %11s %9s %8s %8s %8s %10s %9s %8s %8s %7s\n", "scene", "N", "vol/removed", "rms m", "rms h",
                "max h", "edge h", "median ms", "p99 ms", "touched", "changed", "B/ray");
    for (const Row& r : rows) {
        std::printf("%-12s %4d %11.3e %9.2e %8.5f %8.4f %8.5f %10.3f %9.3f %8.0f %8.0f %7.1f\n", r.scene.c_str(),
                    r.resolution, r.errors.volume, r.errors.surface_rms_m, r.errors.surface_rms_m / r.h_m,
                    r.errors.surface_max_m / r.h_m, r.errors.edge_max_m / r.h_m, r.median_ms, r.p99_ms, r.rays_touched,
                    r.rays_changed, r.bytes_a_ray);
    }
}

struct Options {
    bool as_json = false;
    std::string csv_file;
    int threads = 0, largest = 256;
};

// False on a word that is not understood.
bool parse(int argc, char** argv, Options& options) {
    const auto whole = [](const char* text, int& value) {
        const char* end = text + std::strlen(text);
        return std::from_chars(text, end, value).ptr == end && value >= 0;
    };
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        const bool more = i + 1 < argc;
        if (word == "--json") {
            options.as_json = true;
        } else if (word == "--csv" && more) {
            options.csv_file = argv[++i];
        } else if (!(word == "--threads" && more && whole(argv[++i], options.threads)) &&
                   !(word == "--largest" && more && whole(argv[++i], options.largest))) {
            return false;
        }
    }
    return true;
}

}  // namespace
}  // namespace burin

int main(int argc, char** argv) {
    burin::Options options;
    if (!burin::parse(argc, argv, options)) {
        std::fprintf(stderr, "usage: bench_stroke [--json] [--csv FILE] [--threads N] [--largest N]\n");
        return 2;
    }
    burin::WorkerPool pool(static_cast<unsigned>(options.threads));
    std::vector<burin::Row> rows;
    for (const auto& scene : {burin::test::ball_scene(), burin::test::capsule_scene(), burin::test::cavity_scene(),
                              burin::test::stroke_1000_scene()}) {
        for (const int resolution : {64, 128, 256}) {
            if (resolution <= options.largest) rows.push_back(burin::carve(scene, resolution, pool));
        }
    }
    if (options.as_json) {
        std::fputs(burin::json(rows, pool.threads()).c_str(), stdout);
    } else {
        burin::print_table(rows);
    }
    if (!options.csv_file.empty()) {
        std::ofstream file(options.csv_file);
        file << burin::csv(rows, pool.threads());
        if (!file.flush()) {
            std::fprintf(stderr, "%s: cannot be written; choose a folder that exists\n", options.csv_file.c_str());
            return 1;
        }
    }
    return 0;
}
