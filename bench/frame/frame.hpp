// SPDX-License-Identifier: MIT
// Measures the cost of drawing: frames of one scene (bench/frame/frame_scene.hpp) drawn by Burin and by its peers, off
// screen, both eyes, without read-back. The figure is the processor time of the process for each frame with everything
// that the program does for it, and wall time beside it.
//
// moving: the head moves along its path, so that everything is redrawn. still: head and surface stay. carving: the head
// stays and a few patches change each frame; computing their vertices is not timed, uploading them is. idle: what a
// session's loop uses while nothing happens. first: from the start of the process to the first finished picture,
// without making the surface.
//
// Burin and its peers do not draw alike when each is set up as its users would: a session lights the workpiece at its
// vertices, with light of lamp, sky and room, and draws levels of detail, which take time to make; peers light every
// pixel with a simple formula and draw all triangles. So each is measured in other ways too (FrameWay); kComparisons
// says which rows are set against which, down to the same light and the same triangles.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "base/json.hpp"
#include "bench/frame/frame_scene.hpp"

namespace burin::bench {

struct FrameStep {
    wall::Viewer viewer;
    std::span<const PatchChange> changes;
};

using FrameCounters = std::vector<std::pair<std::string, double>>;

enum class LitAt { pixels, vertices };
enum class FrameLight {
    simple,  // FrameLook's
    burins   // shaders/lighting.glsl: lamp, sky and room, encoded as sRGB and dithered
};
// Says how a subject lights the surface, and whether it draws levels of detail or all triangles.
struct FrameWay {
    LitAt lit_at = LitAt::pixels;
    FrameLight light = FrameLight::simple;
    bool levels = false;
    bool operator==(const FrameWay&) const = default;
};
[[nodiscard]] std::string name_of(LitAt lit_at);
[[nodiscard]] std::string name_of(FrameLight light);
[[nodiscard]] std::string name_of(const FrameWay& way);
inline constexpr FrameWay kSessionWay{LitAt::vertices, FrameLight::burins, true};

// A renderer under test. Constructed with the scene's surface already loaded. One thread.
class FrameSubject {
public:
    virtual ~FrameSubject() = default;
    FrameSubject() = default;
    FrameSubject(const FrameSubject&) = delete;
    FrameSubject& operator=(const FrameSubject&) = delete;

    [[nodiscard]] virtual std::string name() const = 0;
    // Returns how it differs from what was asked for; empty: not at all.
    [[nodiscard]] virtual std::string note() const { return {}; }
    [[nodiscard]] virtual FrameWay way() const { return {}; }
    // Draws both eyes' pictures and returns when they are finished. All of it is timed.
    [[nodiscard]] virtual Result<void> draw(const FrameStep& step) = 0;
    // Called after each warm-up frame and after the last: work that a session does beside the frames and that speeds up
    // later ones. Timed by itself. Returns for how many patches levels of detail were made.
    [[nodiscard]] virtual Result<std::uint64_t> settle() { return 0; }
    // Reads back the last frame. Not timed.
    [[nodiscard]] virtual Result<StereoImage> picture() = 0;
    // Returns the last frame's counts of triangles, draw calls, culled patches and whatever else the subject counts.
    [[nodiscard]] virtual FrameCounters counters() const { return {}; }
    // Runs an iteration of a session's loop in which nothing happens:
    // returns after at most this time, having drawn nothing.
    [[nodiscard]] virtual Result<void> wait(double at_most_s);
};

enum class FrameMotion { moving, still, carving };
[[nodiscard]] std::string name_of(FrameMotion motion);

struct FrameOptions {
    std::size_t triangles = 200'000, triangles_a_patch = kTrianglesAPatch;
    unsigned samples = 1;  // a pixel: 1 or 4
    unsigned frames = 60;
    unsigned warm_up = 10;  // frames that are drawn first and not counted
    std::vector<FrameMotion> motions{FrameMotion::moving, FrameMotion::still, FrameMotion::carving};
    bool idle = true, first = true;
    double idle_s = 2.0;
    bool osg = false, vtk = false;
    bool other_ways = true;          // with a moving head also in the other ways of kComparisons
    std::optional<unsigned> device;  // index in `burin --version`'s list; unset: the best device
};

// Levels of detail that were made for some frames, with the processor time of all threads.
struct LevelsMade {
    std::uint64_t patches = 0;
    double cpu_ms = 0.0;
};

struct FrameTimes {
    std::string subject, note;
    FrameWay way;
    FrameMotion motion = FrameMotion::moving;
    std::vector<double> cpu_ms, wall_ms;  // one value a frame
    FrameCounters counters;               // means
    LevelsMade levels;                    // in the warm-up, the first time from nothing: not in the frames' times
    LevelsMade levels_after;  // that the measured frames left to be made: patches that changed or came to view
    double coverage = 0.0;    // of the left eye's last picture
    double expected_coverage = 0.0;
    std::optional<double> flip_from_own;  // mean FLIP of the left pictures, from a session's
    StereoImage pictures;                 // the last frame
};

struct IdleCost {
    double seconds = 0.0, cpu_share = 0.0;  // of one core
};

struct FirstPicture {
    double wall_ms = 0.0, cpu_ms = 0.0;  // since the process began (to 10 ms), less the making of the surface
};

struct FrameReport {
    std::string machine, device;
    FrameOptions options;
    std::size_t triangles = 0, patches = 0;
    std::vector<FrameTimes> times;
    std::optional<IdleCost> idle;
    std::optional<FirstPicture> first;
    std::vector<std::string> left_out;  // with the reason
};

// Burin's own renderer with the surface loaded; `device_name` is the device that it draws on.
struct OwnSubject {
    std::unique_ptr<FrameSubject> subject;
    std::string device_name;
};
[[nodiscard]] Result<OwnSubject> open_own(const FrameScene& scene, const FrameOptions& options,
                                          const FrameWay& way = kSessionWay);

// The constants of Burin's light on the workpiece, for peers that draw the same picture. Colours are linear.
struct BurinsLight {
    Vec3 to_light_world{0.0}, light{0.0}, sky{0.0}, ground{0.0}, surface{0.0};
    double roughness = 0.0, gloss = 0.0;
};
[[nodiscard]] BurinsLight burins_light(const FrameLook& look);

// Returns an Error when a draw fails, or when the picture shows more or less of the surface than it should.
[[nodiscard]] Result<FrameTimes> time_frames(FrameSubject& subject, const FrameScene& scene, FrameMotion motion,
                                             const FrameOptions& options);
[[nodiscard]] Result<IdleCost> time_idle(FrameSubject& subject, double seconds);

// notify(line) is called before each part. A peer that cannot run is left out, and the report gives the reason.
[[nodiscard]] Result<FrameReport> run_frames(const FrameOptions& options,
                                             const std::function<void(const std::string&)>& notify);

// Sets a way of Burin against a way of its peers; names hold no comma.
struct FrameComparison {
    const char* name;
    FrameWay own, peer;
};
inline constexpr std::array<FrameComparison, 7> kComparisons{{
    {"as set up", kSessionWay, {}},
    {"both at pixels", {LitAt::pixels, FrameLight::burins, true}, {}},
    {"both at vertices", kSessionWay, {LitAt::vertices, FrameLight::simple, false}},
    {"same light at pixels", {LitAt::pixels, FrameLight::burins, true}, {LitAt::pixels, FrameLight::burins, false}},
    {"same light at vertices", kSessionWay, {LitAt::vertices, FrameLight::burins, false}},
    {"same light and triangles at pixels",
     {LitAt::pixels, FrameLight::burins, false},
     {LitAt::pixels, FrameLight::burins, false}},
    {"same light and triangles at vertices",
     {LitAt::vertices, FrameLight::burins, false},
     {LitAt::vertices, FrameLight::burins, false}},
}};

// Returns Burin's median processor time over that of the faster variant of a peer whose name begins with `peer`;
// nullopt where either was not measured.
[[nodiscard]] std::optional<double> own_over_peer(const FrameReport& report, FrameMotion motion,
                                                  const std::string& peer,
                                                  const FrameComparison& compared = kComparisons[0]);

// Returns the cold making of levels in frames of a session, by their median; nullopt where no levels were made.
[[nodiscard]] std::optional<double> levels_in_frames(const FrameReport& report);

[[nodiscard]] std::string frame_table(const FrameReport& report);
// Returns a comment line that names the machine, one of column names, and a row for each subject and motion.
[[nodiscard]] std::string frame_csv(const FrameReport& report);
// Returns a row for each ratio, to be collected over many runs; a line of column names before it if asked for.
[[nodiscard]] std::string ratio_rows(const FrameReport& report, const std::string& driver_threads, bool with_names);
[[nodiscard]] Json frame_json(const FrameReport& report);

}  // namespace burin::bench
