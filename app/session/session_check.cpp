// SPDX-License-Identifier: MIT
#include "app/session/session_check.hpp"

namespace burin {
namespace {

class Fnv {
public:
    explicit Fnv(std::uint64_t seed = 0) : sum_(14695981039346656037u ^ seed) {}
    void add(std::uint64_t bits) {
        for (int i = 0; i < 64; i += 8) add_byte(static_cast<unsigned char>(bits >> i));
    }
    void add(double x) { add(std::bit_cast<std::uint64_t>(x)); }
    void add(const Vec3& v) {
        for (int i = 0; i < 3; ++i) add(v[i]);
    }
    void add(const Quat& q) {
        for (const double x : {q.w, q.x, q.y, q.z}) add(x);
    }
    void add_bytes(std::span<const std::byte> bytes) {
        for (const std::byte byte : bytes) add_byte(static_cast<unsigned char>(byte));
    }
    [[nodiscard]] std::uint64_t sum() const { return sum_; }

private:
    void add_byte(unsigned char byte) { sum_ = (sum_ ^ byte) * 1099511628211u; }
    std::uint64_t sum_;
};

}  // namespace

void SessionCheck::tick(const TickRecord& record) {
    Fnv fnv(check_);
    fnv.add(static_cast<std::uint64_t>(record.time_ns));
    fnv.add(static_cast<std::uint64_t>(record.sample.time_ns));
    fnv.add(record.surface_sequence);
    fnv.add(record.parameter_sequence);
    for (const Vec3& v : {record.sample.position_device_m, record.hip_object_m, record.proxy_object_m,
                          record.cut_object_m, record.given.force_device_N, record.given.torque_device_Nm})
        fnv.add(v);
    fnv.add(record.sample.orientation_device);
    fnv.add(std::uint64_t{record.flags} << 32 | record.sample.buttons);
    check_ = fnv.sum();
    ticks_.push_back({record.tick, check_});
}

std::uint64_t SessionCheck::frame(std::uint64_t tick, const SessionState& state) {
    while (ticks_.size() > 1 && ticks_[1].tick <= tick) ticks_.pop_front();
    Fnv fnv(!ticks_.empty() && ticks_.front().tick <= tick ? ticks_.front().check : 0);
    for (const Similarity& pose : {state.world_from_object, state.world_from_device}) {
        fnv.add(pose.position_m);
        fnv.add(pose.orientation);
        fnv.add(pose.scale);
    }
    for (const Pose& head : {state.head.poses.left_tracker, state.head.poses.right_tracker}) {
        fnv.add(head.position_m);
        fnv.add(head.orientation);
    }
    fnv.add(state.desk.target_device_m);
    fnv.add(static_cast<std::uint64_t>(state.output.mode));
    return fnv.sum();
}

std::uint64_t check_of(const Surface& surface) {
    Fnv fnv;
    for (std::uint32_t i = 0; i < surface.tile_count(); ++i) {
        const auto tile = surface.shared_tile(i);
        if (!tile) continue;
        fnv.add(std::uint64_t{i});
        fnv.add_bytes(std::as_bytes(std::span(tile->vertices)));
        fnv.add_bytes(std::as_bytes(std::span(tile->indices)));
    }
    return fnv.sum();
}

}  // namespace burin
