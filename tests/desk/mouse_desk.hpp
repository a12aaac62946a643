// SPDX-License-Identifier: MIT
// A session whose user has a mouse alone: an own part, a cursor that is moved at its own rate, frames at theirs.
// Where the cursor has to be for a place of the part is worked out here by projecting the place, and what was carved is
// read from the mesh that an export would hold.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "compute/engine/chosen_engine.hpp"
#include "desk/live/desk.hpp"
#include "desk/run/session_frames.hpp"
#include "haptics/haptic_loop.hpp"
#include "tests/session/carving_setup.hpp"
#include "tests/support/run_command.hpp"
#include "wall/projection.hpp"
#include "wall/seen_place.hpp"

namespace burin::session {

using Corners = std::vector<Vec3>;

// An STL file in millimetres of triangles, three corners each.
inline std::string stl_of(const Corners& corners_mm) {
    std::string text = "solid part\n";
    for (std::size_t i = 0; i < corners_mm.size(); ++i) {
        if (i % 3 == 0) text += "facet normal 0 0 0\nouter loop\n";
        const Vec3& p = corners_mm[i];
        text += "vertex " + std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z) + "\n";
        if (i % 3 == 2) text += "endloop\nendfacet\n";
    }
    return text + "endsolid\n";
}

inline void add_quad(Corners& to, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    for (const Vec3& corner : {a, b, c, a, c, d}) to.push_back(corner);
}

// A plate of 80 x 60 mm with its lowest corner at the origin.
inline std::string plate(double thick_mm) {
    Corners all;
    const auto at = [&](int x, int y, int z) { return Vec3(80.0 * x, 60.0 * y, thick_mm * z); };
    add_quad(all, at(0, 0, 0), at(0, 1, 0), at(1, 1, 0), at(1, 0, 0));
    add_quad(all, at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1));
    add_quad(all, at(0, 0, 0), at(1, 0, 0), at(1, 0, 1), at(0, 0, 1));
    add_quad(all, at(0, 1, 0), at(0, 1, 1), at(1, 1, 1), at(1, 1, 0));
    add_quad(all, at(1, 0, 0), at(1, 1, 0), at(1, 1, 1), at(1, 0, 1));
    add_quad(all, at(0, 0, 0), at(0, 0, 1), at(0, 1, 1), at(0, 1, 0));
    return stl_of(all);
}

class MouseDesk {
public:
    static constexpr ImageSize kWindow{1280, 720};

    explicit MouseDesk(const std::string& part_stl, const std::string& tool = "ball:0.004", int frames_per_s = 60,
                       int resolution = 128, double room = 0.0)
        : frame_ns_(1'000'000'000 / frames_per_s) {
        place_.write("part.stl", part_stl);
        options.carve.workpiece.source = part_stl.empty() ? "ball:0.04" : (place_ / "part.stl").string();
        options.carve.workpiece.resolution = resolution;
        options.carve.workpiece.room = room;
        options.hands.tool.shape = tool;
        options.hands.mouse = MouseMode::surface;
        open();
        run({{CommandInput{"toggle-panel", {}}, 0}});
    }

    struct Timed {
        Input input;
        Nanoseconds after_ns = 0;  // since the one before
    };
    // Gives inputs at their times, and goes on for a while.
    void run(const std::vector<Timed>& inputs, Nanoseconds rest_ns = 0) {
        for (const Timed& one : inputs) events_.push_back({told_ns_ += one.after_ns, one.input});
        told_ns_ += rest_ns;
        while (next_ns_ <= told_ns_) frame();
    }
    void rest(double seconds) { run({}, nanoseconds(seconds)); }

    // Where a place of the part is seen, in pixels of the main screen's window; of two pictures in it in the first.
    [[nodiscard]] Vec2 px_of(const Vec3& place_mm) const {
        return px_of_world(desk->session().state().world_from_object * (1e-3 * place_mm));
    }
    [[nodiscard]] Vec2 px_of_world(const Vec3& place_world) const {
        const std::size_t screen = desk->room().wall.main;
        const View view = desk->seen().view_of(screen);
        const Vec3 eye = wall::middle_of(wall::eyes_of(view.viewer));
        const Vec2 at_m = wall::point_on_screen(view.screen, eye, place_world);
        const double wide_m = glm::length(view.screen.lower_right_world - view.screen.lower_left_world);
        const wall::StereoMode mode = desk->output_on(screen).mode;
        const ImageSize eye_px = wall::eye_size(mode, output.size);
        const double per_m = eye_px.width / wide_m;
        return Vec2{at_m.x * per_m, eye_px.height - at_m.y * per_m} / wall::picture_px_per_px(mode);
    }
    void move_to(const Vec2& px) { run({{MouseMove{px}, 8'000'000}}); }
    void point_at(const Vec3& place_mm) {
        move_to(px_of(place_mm));
        rest(0.4);
    }
    void press() { run({{MouseClick{}, 8'000'000}}, 300'000'000); }
    void release() { run({{MouseClick{MouseButton::left, false, {}}, 300'000'000}}, 700'000'000); }
    // Moves the cursor along a line of the window, 125 times a second.
    void drag(const Vec2& from_px, const Vec2& to_px, double px_per_s = 250.0) {
        const int steps = std::max(1, static_cast<int>(glm::length(to_px - from_px) / px_per_s * 125.0));
        std::vector<Timed> way;
        for (int i = 1; i <= steps; ++i)
            way.push_back({MouseMove{glm::mix(from_px, to_px, 1.0 * i / steps)}, 8'000'000});
        run(way);
    }
    // A stroke along places of the part.
    void stroke(const std::vector<Vec3>& places_mm, double px_per_s = 250.0) {
        point_at(places_mm.front());
        press();
        for (std::size_t i = 1; i < places_mm.size(); ++i) drag(px_of(places_mm[i - 1]), px_of(places_mm[i]), px_per_s);
        release();
    }
    [[nodiscard]] std::string told_while(const std::vector<Timed>& inputs) {
        testing::internal::CaptureStderr();
        run(inputs, 100'000'000);
        return testing::internal::GetCapturedStderr();
    }

    // Vertices of the part as it is now, mm.
    [[nodiscard]] std::vector<Vec3> vertices_mm() const {
        std::vector<Vec3> all = desk->session().scene_side().surface()->welded().positions_m;
        for (Vec3& p : all) p *= 1e3;
        return all;
    }
    [[nodiscard]] double cell_mm() const { return 1e3 * desk->session().scene_side().surface()->lattice().spacing_m; }
    [[nodiscard]] Vec3 tool_mm() const { return 1e3 * tool_.proxy_object_m; }
    [[nodiscard]] const haptics::ToolState& tool() const { return tool_; }
    [[nodiscard]] std::size_t strokes() const { return strokes_; }
    [[nodiscard]] Session& session() const { return desk->session(); }
    [[nodiscard]] const Viewer& viewer() const { return desk->viewer(); }

    SessionSetup options = carving_setup();
    wall::OutputPlace output{.size = kWindow};
    bool draws = true;   // the frames take what has changed of the surface
    bool tells = false;  // the session is told of its document, as a window's is
    SimulatedClock clock;
    std::unique_ptr<Desk> desk;

protected:
    // A desk that is opened later, with options of its own.
    MouseDesk() = default;
    void open() {
        options.carve.engine = compute::EngineChoice::cpu;
        if (const auto settled = settle_mouse(options); !settled) throw std::runtime_error(settled.error().line());
        auto made = Desk::create(options, session_wall(options.desk).value(), clock);
        if (!made) throw std::runtime_error(made.error().line());
        desk = std::move(*made);
        desk->take_loaded();
    }
    [[nodiscard]] const Workplace& place() const { return place_; }
    [[nodiscard]] Nanoseconds now_ns() const { return next_ns_ - frame_ns_; }

private:
    void frame() {
        while (next_update_ns_ <= next_ns_) {
            while (clock.now_ns() < next_update_ns_) {
                clock.sleep_until(clock.now_ns() + desk->session().loop().period_ns());
                static_cast<void>(desk->session().loop().step());
            }
            ASSERT_TRUE(desk->session().scene().update(clock.now_ns()));
            static_cast<void>(desk->session().collect({}));
            next_update_ns_ += 10'000'000;
        }
        std::vector<InputEvent> now;
        while (taken_ < events_.size() && events_[taken_].time_ns <= next_ns_) now.push_back(events_[taken_++]);
        if (tells)
            for (CommandInput& told : desk->session().take_told()) now.push_back({next_ns_, std::move(told)});
        tool_ = desk->session().newest_tool();
        static_cast<void>(desk->session().log().take_events());  // as before each step of a session in real time
        desk->step({next_ns_, next_ns_, now}, output, tool_, [this](const scene::SceneThread::Order& order) {
            order();
            desk->session().scene().finish();  // an export
        });
        desk->take_news(Executor::kAllCollected);
        if (draws)
            for (const scene::SurfaceUpdate& update : desk->take_surface_updates()) strokes_ = update.undoable;
        next_ns_ += frame_ns_;
    }

    Workplace place_;
    Nanoseconds frame_ns_ = 1'000'000'000 / 60, next_ns_ = 0, told_ns_ = 0, next_update_ns_ = 10'000'000;
    std::vector<InputEvent> events_;
    std::size_t taken_ = 0, strokes_ = 0;
    haptics::ToolState tool_;
};

}  // namespace burin::session
