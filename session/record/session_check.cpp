// SPDX-License-Identifier: MIT
#include "session/record/session_check.hpp"

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

StateWords words_of(const SessionState& state) {
    StateWords words{};
    WordList list(words);
    for (const Similarity& pose : {state.world_from_object, state.world_from_device}) {
        list.add(pose.position_m);
        list.add(pose.orientation);
        list.add(pose.scale);
    }
    for (const Pose& head : {state.head.poses.left_tracker, state.head.poses.right_tracker}) {
        list.add(head.position_m);
        list.add(head.orientation);
    }
    list.add(state.desk.target_device_m);
    list.add(static_cast<std::uint64_t>(state.output.mode));
    BURIN_CHECK(list.is_full());
    return words;
}

void SessionCheck::tick(std::size_t part, const haptics::TickRecord& record) {
    Part& own = parts_[part];
    CheckSum sum(own.check);
    sum.add(static_cast<std::uint64_t>(record.time_ns));
    sum.add(static_cast<std::uint64_t>(record.sample.time_ns));
    sum.add(record.surface_sequence);
    sum.add(record.parameter_sequence);
    for (const Vec3& v :
         {record.sample.position_device_m, record.deepest().hip_object_m, record.deepest().proxy_object_m,
          record.contact.cut_object_m, record.gate.given.force_device_N, record.gate.given.torque_device_Nm})
        sum.add(v);
    sum.add(record.sample.orientation_device);
    sum.add(std::uint64_t{record.flags} << 32 | record.sample.buttons);
    own.check = sum.sum();
    own.ticks.push_back({record.tick, own.check});
}

std::uint64_t SessionCheck::Part::at(std::uint64_t tick) {
    while (ticks.size() > 1 && ticks[1].tick <= tick) ticks.pop_front();
    return !ticks.empty() && ticks.front().tick <= tick ? ticks.front().check : 0;
}

std::uint64_t SessionCheck::frame(std::span<const std::uint64_t> ticks, const StateWords& state) {
    CheckSum sum(parts_.front().at(ticks.front()));
    for (const std::uint64_t word : state) sum.add(word);
    for (std::size_t part = 1; part < parts_.size(); ++part) sum.add(parts_[part].at(ticks[part]));
    return sum.sum();
}

}  // namespace burin::session
