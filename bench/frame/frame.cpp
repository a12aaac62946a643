// SPDX-License-Identifier: MIT
#include "bench/frame/frame.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>

#include "base/statistics.hpp"
#include "base/try.hpp"
#include "bench/frame/frame_display.hpp"
#include "bench/frame/frame_peers.hpp"
#include "bench/measure/flip.hpp"
#include "bench/measure/timing.hpp"

namespace burin::bench {
namespace {

constexpr const char* kOwn = "Burin";
// The bumps move the outline by up to 2 % of the radius, both
// ways; eight hundredths of an outline's worth of pixels at most.
constexpr double kCoverageTolerance = 0.02;

wall::Viewer viewer_in(const FrameScene& scene, FrameMotion motion, unsigned frame) {
    return motion == FrameMotion::moving ? moving_viewer(scene, frame) : still_viewer(scene);
}

// Adds a frame's counts to the sums, which are divided by the number of frames at the end.
void add(FrameCounters& sums, const FrameCounters& counts) {
    if (sums.empty())
        sums = counts;
    else
        for (std::size_t i = 0; i < std::min(sums.size(), counts.size()); ++i) sums[i].second += counts[i].second;
}

Result<void> settle(FrameSubject& subject, LevelsMade& made) {
    const double before_ms = process_cpu_ms();
    BURIN_TRY(patches, subject.settle());
    made.patches += patches;
    made.cpu_ms += process_cpu_ms() - before_ms;
    return {};
}

Result<void> check_coverage(const FrameTimes& times) {
    const double apart = times.coverage - times.expected_coverage;
    if (std::abs(apart) <= kCoverageTolerance) return {};
    const auto percent = [](double share) {
        return std::to_string(static_cast<int>(std::lround(100.0 * share))) + " %";
    };
    return fail(times.subject,
                "its picture shows the surface on " + percent(times.coverage) + " of the pixels instead of " +
                    percent(times.expected_coverage),
                "its times mean nothing; look at its picture with --pictures");
}

class Run {
public:
    Run(const FrameOptions& options, const std::function<void(const std::string&)>& notify) : tell_(notify) {
        report_.options = options;
        report_.machine = machine();
    }

    Result<FrameReport> all() {
        BURIN_TRY_DO(open());
        BURIN_TRY_DO(measure_own());
        own_.subject.reset();
        BURIN_TRY_DO(measure_own_ways());
        measure_peers();
        compare_pictures();
        return std::move(report_);
    }

private:
    [[nodiscard]] const FrameOptions& options() const { return report_.options; }
    Result<void> open();
    [[nodiscard]] bool other_ways() const {
        return options().other_ways &&
               std::ranges::find(options().motions, FrameMotion::moving) != options().motions.end();
    }
    Result<void> measure_own();
    Result<void> measure_own_ways();
    void measure_peers();
    void measure_peer(const char* name, Result<std::unique_ptr<FrameSubject>> subject,
                      const std::vector<FrameMotion>& motions);
    void compare_pictures();

    std::function<void(const std::string&)> tell_;
    FrameReport report_;
    FrameScene scene_;
    OwnSubject own_;
};

// Measures what a user waits for, except the making of the surface,
// which is computed here and read from a file in a session.
Result<void> Run::open() {
    const double before_wall_ms = wall_since_start_ms(), before_cpu_ms = process_cpu_ms();
    scene_ = make_frame_scene(options().triangles, options().triangles_a_patch);
    const double making_wall_ms = wall_since_start_ms() - before_wall_ms,
                 making_cpu_ms = process_cpu_ms() - before_cpu_ms;
    report_.triangles = scene_.triangles();
    report_.patches = scene_.patches.size();

    BURIN_TRY(own, open_own(scene_, options()));
    own_ = std::move(own);
    report_.device = own_.device_name;
    BURIN_TRY_DO(own_.subject->draw({still_viewer(scene_), {}}));
    if (options().first) report_.first = {wall_since_start_ms() - making_wall_ms, process_cpu_ms() - making_cpu_ms};
    return {};
}

Result<void> Run::measure_own() {
    for (const FrameMotion motion : options().motions) {
        tell_(std::string(kOwn) + ", " + name_of(motion));
        BURIN_TRY(times, time_frames(*own_.subject, scene_, motion, options()));
        report_.times.push_back(std::move(times));
    }
    if (!options().idle) return {};
    tell_(std::string(kOwn) + ", idle");
    BURIN_TRY(idle, time_idle(*own_.subject, options().idle_s));
    report_.idle = idle;
    return {};
}

// Each way has a renderer of its own, so that the levels of detail are made anew.
Result<void> Run::measure_own_ways() {
    if (!other_ways()) return {};
    std::vector<FrameWay> done{kSessionWay};
    for (const FrameComparison& compared : kComparisons) {
        if (std::ranges::find(done, compared.own) != done.end()) continue;
        done.push_back(compared.own);
        tell_(std::string(kOwn) + ", " + name_of(compared.own));
        BURIN_TRY(own, open_own(scene_, options(), compared.own));
        BURIN_TRY(times, time_frames(*own.subject, scene_, FrameMotion::moving, options()));
        report_.times.push_back(std::move(times));
    }
    return {};
}

void Run::measure_peers() {
    if ((!options().osg && !options().vtk) || options().motions.empty()) return;
    const auto display = FrameDisplay::open();
    if (!display) {
        report_.left_out.push_back("peers: " + display.error().line());
        return;
    }
    std::vector<FrameWay> done;
    for (const FrameComparison& compared : kComparisons) {
        const FrameWay& way = compared.peer;
        if (std::ranges::find(done, way) != done.end() || (!done.empty() && !other_ways())) continue;
        const auto motions = done.empty() ? options().motions : std::vector{FrameMotion::moving};
        done.push_back(way);
        if (options().osg) {
            for (const OsgDrawables drawables : {OsgDrawables::patches, OsgDrawables::one})
                measure_peer("OpenSceneGraph", open_osg(scene_, options().samples, drawables, way), motions);
        }
        if (options().vtk) measure_peer("VTK", open_vtk(scene_, options().samples, way), motions);
    }
}

void Run::measure_peer(const char* name, Result<std::unique_ptr<FrameSubject>> subject,
                       const std::vector<FrameMotion>& motions) {
    if (!subject) {
        report_.left_out.push_back(std::string(name) + ": " + subject.error().line());
        return;
    }
    for (const FrameMotion motion : motions) {
        tell_((*subject)->name() + ", " + name_of((*subject)->way()) + ", " + name_of(motion));
        auto times = time_frames(**subject, scene_, motion, options());
        if (times) {
            report_.times.push_back(std::move(*times));
        } else {
            report_.left_out.push_back((*subject)->name() + ", " + name_of(motion) + ": " + times.error().line());
        }
    }
}

void Run::compare_pictures() {
    for (FrameTimes& times : report_.times) {
        const auto own = std::ranges::find_if(report_.times, [&](const FrameTimes& t) {
            return t.subject == kOwn && t.way == kSessionWay && t.motion == times.motion;
        });
        if (own == report_.times.end() || &*own == &times) continue;
        if (const auto map = flip(own->pictures.left, times.pictures.left)) times.flip_from_own = map->mean;
    }
}

}  // namespace

Result<void> FrameSubject::wait(double at_most_s) {
    std::this_thread::sleep_for(std::chrono::duration<double>(at_most_s));
    return {};
}

std::string name_of(FrameMotion motion) {
    switch (motion) {
        case FrameMotion::moving: return "moving";
        case FrameMotion::still: return "still";
        case FrameMotion::carving: return "carving";
    }
    return {};
}

std::string name_of(LitAt lit_at) { return lit_at == LitAt::pixels ? "pixels" : "vertices"; }
std::string name_of(FrameLight light) { return light == FrameLight::simple ? "simple" : "Burin's"; }
std::string name_of(const FrameWay& way) {
    return name_of(way.light) + " light at " + name_of(way.lit_at) + (way.levels ? "" : ", all triangles");
}

Result<FrameTimes> time_frames(FrameSubject& subject, const FrameScene& scene, FrameMotion motion,
                               const FrameOptions& options) {
    FrameTimes times;
    times.subject = subject.name();
    times.note = subject.note();
    times.motion = motion;
    times.way = subject.way();
    wall::Viewer viewer;
    for (unsigned frame = 0; frame < options.warm_up + options.frames; ++frame) {
        viewer = viewer_in(scene, motion, frame);
        const std::vector<PatchChange> changes =
            motion == FrameMotion::carving ? wandering_dent(scene, frame) : std::vector<PatchChange>{};
        Stopwatch watch;
        const double before_ms = process_cpu_ms();
        BURIN_TRY_DO(subject.draw({viewer, changes}));
        const double cpu_ms = process_cpu_ms() - before_ms, wall_ms = watch.lap_ms();
        if (frame < options.warm_up) {
            BURIN_TRY_DO(settle(subject, times.levels));
            continue;
        }
        times.cpu_ms.push_back(cpu_ms);
        times.wall_ms.push_back(wall_ms);
        add(times.counters, subject.counters());
    }
    for (auto& [name, value] : times.counters) value /= static_cast<double>(times.cpu_ms.size());
    BURIN_TRY(pictures, subject.picture());
    times.pictures = std::move(pictures);
    BURIN_TRY_DO(settle(subject, times.levels_after));
    times.coverage = coverage(scene.look, times.pictures.left);
    times.expected_coverage = expected_coverage(scene, wall::eyes_of(viewer).left_world);
    BURIN_TRY_DO(check_coverage(times));
    return times;
}

Result<IdleCost> time_idle(FrameSubject& subject, double seconds) {
    Stopwatch watch;
    const double before_ms = process_cpu_ms();
    double passed_s = 0.0;
    while (passed_s < seconds) {
        BURIN_TRY_DO(subject.wait(seconds - passed_s));
        passed_s += 1e-3 * watch.lap_ms();
    }
    return IdleCost{passed_s, 1e-3 * (process_cpu_ms() - before_ms) / passed_s};
}

Result<FrameReport> run_frames(const FrameOptions& options, const std::function<void(const std::string&)>& notify) {
    return Run(options, notify).all();
}

std::optional<double> own_over_peer(const FrameReport& report, FrameMotion motion, const std::string& peer,
                                    const FrameComparison& compared) {
    double own = 0.0, theirs = 0.0;
    for (const FrameTimes& times : report.times) {
        if (times.motion != motion) continue;
        const double ms = median(times.cpu_ms);
        if (times.subject == kOwn && times.way == compared.own) own = ms;
        if (times.subject.starts_with(peer) && times.way == compared.peer && (theirs == 0.0 || ms < theirs))
            theirs = ms;
    }
    if (own <= 0.0 || theirs <= 0.0) return std::nullopt;
    return own / theirs;
}

std::optional<double> levels_in_frames(const FrameReport& report) {
    const auto first = std::ranges::find_if(report.times, [](const FrameTimes& t) { return t.levels.patches > 0; });
    if (first == report.times.end()) return std::nullopt;
    return first->levels.cpu_ms / median(first->cpu_ms);
}

}  // namespace burin::bench
