// SPDX-License-Identifier: MIT
// A desk whose person is told of the document, as a window's is, and answers what is asked about it: by keys, by the
// mouse, by typing. Files go to the test's own place.
#pragma once

#include <chrono>
#include <thread>

#include "document/document_reader.hpp"
#include "session/input/input_keys.hpp"
#include "tests/desk/mouse_desk.hpp"

namespace burin::session {

class PersonDesk : public MouseDesk {
public:
    static constexpr double kTop_mm = 10.0;

    // source: empty for a plate without a document.
    explicit PersonDesk(const std::string& source = {}, const Workplace* among = nullptr) {
        tells = true;
        place().write("plate.stl", plate(kTop_mm));
        options.carve.workpiece.source = source.empty() ? (place() / "plate.stl").string() : source;
        options.carve.workpiece.resolution = 96;
        options.hands.tool.shape = "ball:0.004";
        options.hands.mouse = MouseMode::surface;
        options.work.journal = ((among != nullptr ? *among : place()) / "journals").string();
        open();
        rest(0.2);
    }

    void key(Key which, const Modifiers& held = {}) {
        run({{KeyInput{which, KeyMotion::press, held}, 30'000'000},
             {KeyInput{which, KeyMotion::release, held}, 30'000'000},
             {KeyInput{Key::ctrl, KeyMotion::release, {}}, 10'000'000}},
            60'000'000);
    }
    void ctrl(Key which) { key(which, {.ctrl = true}); }
    // Types as a keyboard does: the keys and what they mean.
    void type(const std::string& text) {
        for (const char c : text) {
            const auto named = key_named(std::string(1, c));
            if (named) run({{KeyInput{*named, KeyMotion::press, {}}, 20'000'000}});
            run({{TextInput{std::string(1, c)}, 1'000'000}});
            if (named) run({{KeyInput{*named, KeyMotion::release, {}}, 10'000'000}});
        }
        rest(0.05);
    }
    void press_button(const std::string& label) {
        const auto at = desk->place_on_panel(label);
        ASSERT_TRUE(at) << label << " is not shown";
        move_to({at->x + 0.5 * at->width, at->y + 0.5 * at->height});
        run({{MouseClick{}, 50'000'000}, {MouseClick{MouseButton::left, false, {}}, 50'000'000}}, 100'000'000);
    }
    void close_window() { run({{WindowClose{}, 10'000'000}}, 50'000'000); }
    // A stroke across the plate's top, and then the hand rests.
    void carve(double y_mm = 30.0) {
        stroke({{25.0, y_mm, kTop_mm}, {55.0, y_mm, kTop_mm}});
        rest(1.2);
    }
    // Waits until the disk has all that it was given, and the session knows.
    void wait_for_disk() {
        rest(0.1);
        for (int i = 0; i < 4000 && session().work().waits_for_the_disk(); ++i) {
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
            rest(0.02);
        }
        ASSERT_FALSE(session().work().waits_for_the_disk());
        rest(0.1);
    }

    [[nodiscard]] bool is_asked() const { return desk->place_on_panel("question").has_value(); }
    [[nodiscard]] bool has_quit() const { return session().state().quit; }
    [[nodiscard]] const DocumentTold& told() const { return *session().state().asked.told; }
    [[nodiscard]] std::string shown() const { return state_text(told()) + ", " + kept_text(told(), "stroke"); }
    // Ends the session as the program does; returns what it said.
    std::string end() {
        testing::internal::CaptureStderr();
        session().finish_scene();
        return testing::internal::GetCapturedStderr();
    }
    [[nodiscard]] std::size_t journals() const { return files_in("journals"); }
    [[nodiscard]] std::size_t files_in(const std::string& folder) const {
        std::error_code none;
        std::size_t count = 0;
        for (const auto& one : std::filesystem::directory_iterator(place() / folder, none))
            count += one.path().extension() == ".burin" ? 1 : 0;
        return count;
    }
    using MouseDesk::place;
};

// How many pages a document's solid has; 0 where there is no document.
inline std::int64_t saves_of(const std::filesystem::path& path) {
    const auto reader = document::DocumentReader::open(path.string());
    return reader ? reader->version().saves : 0;
}

}  // namespace burin::session
