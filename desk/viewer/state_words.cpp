// SPDX-License-Identifier: MIT
#include "desk/viewer/state_words.hpp"

#include <bit>

namespace burin::session {
namespace {

class WordList {
public:
    explicit WordList(StateWords& words) : words_(words) {}
    void add(double x) { words_[next_++] = std::bit_cast<std::uint64_t>(x); }
    void add(const Vec3& v) {
        for (int i = 0; i < 3; ++i) add(v[i]);
    }
    void add(const Quat& q) {
        for (const double x : {q.w, q.x, q.y, q.z}) add(x);
    }
    void add(std::uint64_t bits) { words_[next_++] = bits; }
    [[nodiscard]] bool is_full() const { return next_ == words_.size(); }

private:
    StateWords& words_;
    std::size_t next_ = 0;
};

}  // namespace

StateWords words_of(const SessionState& state, const Viewer& viewer) {
    StateWords words{};
    WordList list(words);
    for (const Similarity& pose : {state.world_from_object, state.led().world_from_device}) {
        list.add(pose.position_m);
        list.add(pose.orientation);
        list.add(pose.scale);
    }
    for (const Pose& head : {viewer.head.poses.left_tracker, viewer.head.poses.right_tracker}) {
        list.add(head.position_m);
        list.add(head.orientation);
    }
    list.add(viewer.desk.target_device_m);
    list.add(static_cast<std::uint64_t>(viewer.output.mode));
    BURIN_CHECK(list.is_full());
    return words;
}

}  // namespace burin::session
