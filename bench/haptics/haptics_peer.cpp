// SPDX-License-Identifier: MIT
// Times our ticks and CHAI3D's in turn: the same mesh, ball and path, the same machine, in the same second.
#include <algorithm>
#include <memory>

#include "base/statistics.hpp"
#include "base/try.hpp"
#include "bench/haptics/touch_run.hpp"
#include "bench/peers/proxy_peer.hpp"
#include "haptics/channels.hpp"

namespace burin::bench {
namespace {

constexpr Nanoseconds kPeerPeriod_ns = 1'000'000;
constexpr Nanoseconds kSleep_ns = 200'000;  // of the thread before a cold tick

// Whatever moves a proxy after the hand.
class Subject {
public:
    virtual ~Subject() = default;
    // Called before the tick, untimed: `lifted` where the hand has been taken elsewhere.
    virtual void prepare(const PressedWalk& path) = 0;
    virtual Vec3 tick(const Vec3& hip_m) = 0;  // returns the proxy
};

// The whole tick of our loop, with the session's settings.
class WholeTick final : public Subject {
public:
    WholeTick(const TouchedScene& scene, const haptics::TickParameters& parameters)
        : scene_(scene), parameters_(parameters), loop_(device_, clock_, *channels_) {}
    void prepare(const PressedWalk& path) override {
        if (parameters_.enabled == path.lifted() || ticks_ == 0) {
            ++parameters_.sequence;
            parameters_.enabled = !path.lifted();
            channels_->parameters.draft() = parameters_;
            channels_->parameters.publish();
        }
        clock_.sleep_until(clock_.now_ns() + kPeerPeriod_ns);
        if (ticks_++ % TouchRun::kTicksAnUpdate == 0) {
            fill(channels_->surface.draft(), scene_, ticks_, clock_.now_ns());
            channels_->surface.publish();
        }
        for (haptics::TickRecord read; channels_->records.pop(read);) {
        }
        for (haptics::TickRecord read; channels_->ticks.pop(read);) {
        }
        orientation_ = path.orientation();
    }
    Vec3 tick(const Vec3& hip_m) override {
        device_.go_to(hip_m, orientation_, clock_.now_ns());
        return loop_.step().contact.points[0].proxy_object_m;
    }

private:
    const TouchedScene& scene_;
    haptics::TickParameters parameters_;
    SimulatedClock clock_;
    PathDevice device_;
    std::unique_ptr<haptics::HapticChannels> channels_ = std::make_unique<haptics::HapticChannels>();
    haptics::HapticLoop loop_;
    Quat orientation_{1.0, 0.0, 0.0, 0.0};
    std::uint64_t ticks_ = 0;
};

// Times our proxy alone, which is the part of a tick that the peer has too.
class ContactAlone final : public Subject {
public:
    ContactAlone(const TouchedScene& scene, const haptics::ProxySettings& settings) : settings_(settings) {
        fill(surface_, scene, 1, 0);
    }
    void prepare(const PressedWalk& path) override {
        if (path.lifted()) state_ = {path.hip_m(), 1, false};
    }
    Vec3 tick(const Vec3& hip_m) override {
        state_ = haptics::move_proxy(state_, hip_m, settings_, surface_).next;
        return state_.position_object_m;
    }

private:
    haptics::ProxySettings settings_;
    geometry::LocalSurface surface_;
    haptics::ProxyState state_;
};

class Peer final : public Subject {
public:
    explicit Peer(std::unique_ptr<ProxyPeer> peer) : peer_(std::move(peer)) {}
    void prepare(const PressedWalk& path) override {
        if (path.lifted()) peer_->put(path.hip_m());
    }
    Vec3 tick(const Vec3& hip_m) override { return peer_->step(hip_m); }

private:
    std::unique_ptr<ProxyPeer> peer_;
};

struct Compared {
    const TouchedScene& scene;
    const NamedProbe& probe;
    bool friction;
};

struct NamedSubject {
    std::string name;
    std::unique_ptr<Subject> subject;
};

Result<std::vector<NamedSubject>> subjects_of(const Compared& of) {
    const haptics::TickParameters parameters = session_parameters(of.probe.probe, of.friction);
    const haptics::TouchMaterial& material = parameters.materials[0];
    haptics::ProxySettings settings;
    settings.contact_radius_m = of.probe.radius_m * (1.0 - parameters.clearance_ratio);
    settings.static_friction = material.static_friction, settings.dynamic_friction = material.dynamic_friction;
    std::vector<NamedSubject> subjects;
    subjects.push_back({"burin_tick", std::make_unique<WholeTick>(of.scene, parameters)});
    subjects.push_back({"burin_contact", std::make_unique<ContactAlone>(of.scene, settings)});
    settings.shading = false;
    subjects.push_back({"burin_unshaded", std::make_unique<ContactAlone>(of.scene, settings)});
    for (const bool dynamic : {false, true}) {
        BURIN_TRY(peer, open_chai3d(of.scene.mesh, {settings.contact_radius_m, settings.static_friction,
                                                    settings.dynamic_friction, dynamic}));
        subjects.push_back({dynamic ? "chai3d_dynamic" : "chai3d_static", std::make_unique<Peer>(std::move(peer))});
    }
    return subjects;
}

PressedWalk path_of(const Compared& of) { return {of.scene.walk, {.above_m = of.probe.radius_m + 0.005}}; }

double timed_tick_us(Subject& subject, const Vec3& hip_m, Vec3& proxy_m) {
    MonotonicClock clock;
    const Nanoseconds began_ns = clock.now_ns();
    proxy_m = subject.tick(hip_m);
    return 1e-3 * static_cast<double>(clock.now_ns() - began_ns);
}

// Judges where a proxy is.
void judge(PeerTicks& ticks, const Compared& of, double radius_m, const Vec3& hip_m, const Vec3& proxy_m) {
    const double distance_m = of.scene.tree.nearest(proxy_m, 0).distance_m;
    ticks.sunk_um.push_back(1e6 * std::max(radius_m - distance_m, 0.0));
    ticks.from_hand_mm.push_back(1e3 * glm::length(proxy_m - hip_m));
    if (radius_m > 0.0) return;
    const auto nearest = of.scene.tree.nearest(hip_m, 0);
    const auto& [a, b, c] = of.scene.mesh.triangles[nearest.triangle];
    const std::vector<Vec3>& p = of.scene.mesh.positions_m;
    ticks.from_nearest_um.push_back(1e6 * glm::length(proxy_m - geometry::nearest_point({p[a], p[b], p[c]}, hip_m)));
}

// Cold: all of them in turn, each after the caches were written over and the thread has slept.
void take_cold(std::span<NamedSubject> subjects, std::span<PeerTicks> ticks, const Compared& of, std::uint64_t count) {
    MonotonicClock clock;
    CacheEvictor evictor;
    PressedWalk path = path_of(of);
    for (std::uint64_t counted = 0; counted < count;) {
        path.step();
        for (std::size_t i = 0; i < subjects.size(); ++i) {
            Subject& subject = *subjects[i].subject;
            subject.prepare(path);
            if (path.pressed()) {
                evictor.evict();
                clock.sleep_until(clock.now_ns() + kSleep_ns);
            }
            Vec3 proxy_m;
            const double took_us = timed_tick_us(subject, path.hip_m(), proxy_m);
            if (path.pressed()) ticks[i].cold_us.push_back(took_us);
        }
        if (path.pressed()) ++counted;
    }
}

void take_back_to_back(Subject& subject, PeerTicks& ticks, const Compared& of, std::uint64_t count) {
    const double radius_m = of.probe.radius_m * (1.0 - session_parameters({}, true).clearance_ratio);
    PressedWalk path = path_of(of);
    std::vector<Vec3> without_contact_m;
    while (ticks.back_to_back_us.size() < count) {
        path.step();
        subject.prepare(path);
        Vec3 proxy_m;
        const double took_us = timed_tick_us(subject, path.hip_m(), proxy_m);
        if (!path.pressed()) continue;
        ticks.back_to_back_us.push_back(took_us);
        judge(ticks, of, radius_m, path.hip_m(), proxy_m);
        if (glm::length(proxy_m - path.hip_m()) < 1e-9) without_contact_m.push_back(path.hip_m());
    }
    ticks.contact_lost = contacts_lost(of.scene, without_contact_m, of.probe.radius_m);
}

Result<void> compare(Haptics& all, const Compared& of) {
    BURIN_TRY(subjects, subjects_of(of));
    std::vector<PeerTicks> ticks(subjects.size());
    for (std::size_t i = 0; i < ticks.size(); ++i) {
        ticks[i].scene = of.scene.name, ticks[i].triangles = of.scene.mesh.triangles.size();
        ticks[i].probe = of.probe.name, ticks[i].radius_m = of.probe.radius_m, ticks[i].friction = of.friction;
        ticks[i].who = subjects[i].name;
    }
    take_cold(subjects, ticks, of, all.options.peer_ticks);
    for (std::size_t i = 0; i < ticks.size(); ++i)
        take_back_to_back(*subjects[i].subject, ticks[i], of, 2 * all.options.peer_ticks);
    std::ranges::move(ticks, std::back_inserter(all.peers));
    return {};
}

}  // namespace

Result<void> measure_peer_ticks(Haptics& all, const Tell& notify) {
    if (!has_chai3d()) {
        all.notes.push_back(open_chai3d({}, {}).error().line());
        return {};
    }
    BURIN_TRY(scenes, touch_scenes(all.options.scenes));
    for (const TouchScene& wanted : scenes.scenes) {
        const auto scene = touched(wanted);
        if (!scene) continue;  // measure_ticks has said why
        for (const NamedProbe& probe : probes_on(0.0)) {
            if (probe.name != "point" && probe.name != "ball_2_mm" && probe.name != "ball_5_mm") continue;
            notify("ours and CHAI3D's in turn on " + wanted.name + ", " + probe.name);
            for (const bool friction : {true, false}) BURIN_TRY_DO(compare(all, {**scene, probe, friction}));
        }
    }
    return {};
}

}  // namespace burin::bench
