// SPDX-License-Identifier: MIT
#include "desk/opening/opening.hpp"

#include <algorithm>
#include <utility>
#include <variant>

#include "base/try.hpp"
#include "desk/opening/opening_picture.hpp"

namespace burin::session {
namespace {

// Between two looks at a work that wakes nobody: its share goes on meanwhile.
constexpr double kLookEvery_s = 0.1;

// Shows the opening's pictures in a window, each when it differs from the one before.
class OpeningFrames {
public:
    OpeningFrames(Presenter& presenter, OpeningPicture picture) : presenter_(presenter), picture_(std::move(picture)) {}

    // Draws what is new; returns whether it was shown.
    bool show(OpeningSight& sight) {
        if (auto look = sight.take_look()) picture_.take(std::move(*look));
        presenter_.look();
        const ImageSize window = presenter_.place().size;
        if (failed_ || is_empty(window)) return false;
        const auto picture = picture_.lay_out(sight.work().look(), clock_.now_ns() - began_ns_, window);
        const Result<bool> drawn = picture ? presenter_.draw_still(*picture) : std::unexpected(picture.error());
        failed_ = !drawn;  // the session says why, when it draws
        return drawn && *drawn;
    }

private:
    Presenter& presenter_;
    OpeningPicture picture_;
    MonotonicClock clock_;
    Nanoseconds began_ns_ = clock_.now_ns();
    bool failed_ = false;
};

}  // namespace

bool ends_opening(const Input& input) {
    if (std::holds_alternative<WindowClose>(input)) return true;
    const auto* key = std::get_if<KeyInput>(&input);
    if (key == nullptr || key->motion != KeyMotion::press) return false;
    return key->key == Key::escape || (key->key == Key::q && key->modifiers.ctrl);
}

Result<std::unique_ptr<workpiece::Workpiece>> open_before_eyes(Presenter& presenter, const SessionSetup& options,
                                                               const SessionWall& wall, OpeningWork::Make make) {
    BURIN_TRY(picture, OpeningPicture::create(options, wall));
    OpeningFrames frames(presenter, std::move(picture));
    OpeningWork work(std::move(make), [&presenter] { presenter.wake(); });
    while (!work.sight().is_finished()) {
        if (frames.show(work.sight())) work.sight().shown();
        if (work.sight().is_finished()) break;
        if (std::ranges::any_of(presenter.inputs(kLookEvery_s), ends_opening)) {
            work.sight().stop();
            presenter.hide_windows();
            return nullptr;
        }
    }
    return work.take();
}

}  // namespace burin::session
