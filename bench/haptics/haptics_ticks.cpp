// SPDX-License-Identifier: MIT
// Times the ticks of the haptic loop.
#include <pthread.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <memory>
#include <thread>

#include "bench/haptics/hand_path.hpp"
#include "bench/haptics/haptics.hpp"
#include "compute/mesher/surface.hpp"
#include "compute/rays/engine.hpp"
#include "geometry/contact/touch_mesh.hpp"
#include "haptics/haptic_loop.hpp"

namespace burin::bench {
namespace {

constexpr Nanoseconds kPeriod_ns = 1'000'000;

struct NamedProbe {
    std::string name;
    haptics::Probe probe;
};

// Returns a point on a sphere of the bumpy sphere's radius, whose top is the origin.
haptics::ProbePoint on_sphere(double x, double z) {
    const double radius = BumpySphere{}.radius_m;
    return {{x, std::sqrt(radius * radius - x * x - z * z) - radius, z}, 0.0};
}

// Returns a wand's two ends, nearer together than the real one's, so that both are on the sphere.
haptics::Probe two_points() {
    haptics::Probe probe;
    probe.count = 2;
    probe.points[0] = on_sphere(0.02, 0.0);
    probe.points[1] = on_sphere(-0.02, 0.0);
    return probe;
}

// Returns four fingers, each a point and its four neighbours, 2 mm apart.
haptics::Probe four_fingers() {
    haptics::Probe probe;
    probe.count = 0;
    for (const double x : {-0.012, 0.012})
        for (const double z : {-0.012, 0.012})
            for (const auto& [dx, dz] : {std::pair{0.0, 0.0}, {0.002, 0.0}, {-0.002, 0.0}, {0.0, 0.002}, {0.0, -0.002}})
                probe.points[probe.count++] = on_sphere(x + dx, z + dz);
    return probe;
}

std::vector<NamedProbe> all_probes() {
    return {{"point", {}},
            {"ball_2_mm", haptics::ball_probe(0.002)},
            {"two_points", two_points()},
            {"20_points", four_fingers()}};
}

haptics::TickParameters parameters_for(const haptics::Probe& probe) {
    haptics::TickParameters parameters;
    parameters.sequence = 1;
    parameters.probe = probe;
    parameters.max_surface_age_s = 0.0;
    parameters.position_noise_m = 1e-9;
    return parameters;
}

// A loop with its channels, and a path that moves its device.
class Run {
public:
    Run(TickCosts& costs, Clock& clock, const haptics::Probe& probe, const BumpySphere& shape)
        : costs_(costs), clock_(clock), path_(shape, {}), loop_(device_, clock, *channels_) {
        channels_->parameters.draft() = parameters_for(probe);
        channels_->parameters.publish();
        path_.step();
    }
    [[nodiscard]] haptics::HapticChannels& channels() { return *channels_; }
    [[nodiscard]] const Vec3& hip_m() const { return path_.hip_m(); }

    void back_to_back(std::uint64_t ticks, const std::function<void(std::uint64_t)>& between) {
        for (std::uint64_t i = 0; i < ticks; ++i) {
            tick(0);
            between(i);
        }
    }
    void paced(std::uint64_t ticks, bool warmed_up) {
        Nanoseconds deadline_ns = clock_.now_ns() + kPeriod_ns;
        for (std::uint64_t i = 0; i < ticks; ++i) {
            clock_.sleep_until(deadline_ns - (warmed_up ? haptics::HapticLoop::kLead_ns : 0));
            if (warmed_up) warm_up(deadline_ns);
            const Nanoseconds lateness_ns = clock_.now_ns() - deadline_ns;
            tick(lateness_ns);
            costs_.lateness_us.push_back(1e-3 * static_cast<double>(lateness_ns));
            const Nanoseconds missed = (clock_.now_ns() - deadline_ns) / kPeriod_ns;
            costs_.skipped_deadlines += static_cast<std::uint64_t>(missed);
            deadline_ns += (missed + 1) * kPeriod_ns;
        }
    }

private:
    void warm_up(Nanoseconds deadline_ns) {
        const Nanoseconds began_ns = clock_.now_ns();
        loop_.warm_up();
        costs_.warm_up_us.push_back(1e-3 * static_cast<double>(clock_.now_ns() - began_ns));
        clock_.spin_until(deadline_ns);
    }
    void tick(Nanoseconds lateness_ns) {
        path_.step();
        device_.go_to(path_.hip_m(), path_.orientation(), time_ns_ += kPeriod_ns);
        const Nanoseconds began_ns = clock_.now_ns();
        const haptics::TickRecord record = loop_.step(lateness_ns);
        const Nanoseconds took_ns = clock_.now_ns() - began_ns;
        costs_.tick_us.push_back(1e-3 * static_cast<double>(took_ns));
        costs_.triangles_tested.push_back(record.contact.work.triangles_tested);
        costs_.triangles_seen.push_back(record.contact.work.triangles_seen);
        if ((record.flags & haptics::kTickInContact) != 0) ++costs_.in_contact;
        if (record.surface_sequence != surface_) ++costs_.surfaces_used;
        surface_ = record.surface_sequence;
        for (haptics::TickRecord read; channels_->records.pop(read);) {
        }
    }

    TickCosts& costs_;
    Clock& clock_;
    PathDevice device_;
    PressedPath path_;
    std::unique_ptr<haptics::HapticChannels> channels_ = std::make_unique<haptics::HapticChannels>();
    haptics::HapticLoop loop_;
    Nanoseconds time_ns_ = 0;
    std::uint64_t surface_ = 0;
};

// Carves from the tool's position towards the hand, as sculpt/ does in a session, without its tools.
class Carver {
public:
    // Share of the way to the hand that an update cuts: the hand moves
    // a millimetre meanwhile, is not left behind, and stays in contact.
    static constexpr double kShare = 0.6, kTool_m = 0.002, kPublished_m = 0.01;

    Carver(compute::Solid solid, haptics::HapticChannels& channels, const Vec3& begin_m)
        : channels_(channels),
          surface_(solid.lattice),
          engine_(compute::make_cpu_engine(std::move(solid), pool_)),
          at_m_(begin_m) {
        surface_.mesh_all(engine_->solid(), pool_);
        publish();
    }
    [[nodiscard]] std::uint64_t triangles() const { return surface_.triangles(); }

    [[nodiscard]] Result<void> update() {
        Vec3 to_m = at_m_;
        for (haptics::StrokeSample stroke; channels_.stroke.pop(stroke);) {
            to_m = stroke.proxy_object_m + kShare * (stroke.position_object_m - stroke.proxy_object_m);
        }
        const compute::BallSweep sweep{at_m_, to_m, kTool_m};
        if (const auto carved = engine_->carve({&sweep, 1}); !carved) return std::unexpected(carved.error());
        surface_.update(engine_->solid(), engine_->take_changes(), pool_);
        at_m_ = to_m;
        publish();
        return {};
    }

private:
    void publish() {
        geometry::LocalSurface& draft = channels_.surface.draft();
        compute::gather_local_surface(surface_, at_m_, kPublished_m, draft);
        draft.sequence = ++sequence_;
        channels_.surface.publish();
    }

    haptics::HapticChannels& channels_;
    WorkerPool pool_{1};
    compute::Surface surface_;
    std::unique_ptr<compute::CarvingEngine> engine_;
    Vec3 at_m_;
    std::uint64_t sequence_ = 0;
};

constexpr std::uint64_t kTicksAnUpdate = 10;

// Carves a hundred times a second, concurrently with the paced ticks.
class CarvingThread {
public:
    explicit CarvingThread(Carver& carver) : thread_([this, &carver] { work(carver); }) {}
    ~CarvingThread() { stop(); }
    Result<void> stop() {
        stop_.store(true, std::memory_order_relaxed);  // relaxed: it only ends the loop; join orders the rest
        if (thread_.joinable()) thread_.join();
        return failure_;
    }

private:
    void work(Carver& carver) {
        // The thread that creates this one may have a real-time priority; carving must not.
        const sched_param none{};
        pthread_setschedparam(pthread_self(), SCHED_OTHER, &none);
        MonotonicClock clock;
        Nanoseconds next_ns = clock.now_ns();
        while (failure_ && !stop_.load(std::memory_order_relaxed)) {
            failure_ = carver.update();
            next_ns = std::max(next_ns + Nanoseconds{kTicksAnUpdate} * kPeriod_ns, clock.now_ns());
            clock.sleep_until(next_ns);
        }
    }
    Result<void> failure_;
    std::atomic<bool> stop_{false};
    std::thread thread_;
};

void publish_mesh(haptics::HapticChannels& channels, const std::shared_ptr<const geometry::TouchSnapshot>& snapshot) {
    geometry::LocalSurface& draft = channels.surface.draft();
    draft.sequence = 1;
    draft.radius_m = 1e3;
    draft.meshes.assign(1, {snapshot, 0});
    channels.surface.publish();
}

enum class Pacing : std::uint8_t { paced, paced_cold, back_to_back };
constexpr std::array kPacings{Pacing::paced, Pacing::paced_cold, Pacing::back_to_back};
constexpr std::array kPacingNames{"paced", "paced_cold", "back_to_back"};

std::string name_of(Pacing pacing) { return kPacingNames[static_cast<std::size_t>(pacing)]; }

void touch_sphere(Haptics& all, const std::shared_ptr<const geometry::TouchSnapshot>& snapshot, const NamedProbe& probe,
                  Pacing pacing) {
    MonotonicClock clock;
    TickCosts& costs = all.ticks.emplace_back();
    costs.scene = "sphere", costs.probe = probe.name, costs.pacing = name_of(pacing);
    costs.triangles = snapshot->triangles();
    Run run(costs, clock, probe.probe, {});
    publish_mesh(run.channels(), snapshot);
    const auto nothing = [](std::uint64_t) {};
    if (pacing != Pacing::back_to_back)
        run.paced(all.options.paced_ticks, pacing == Pacing::paced);
    else
        run.back_to_back(all.options.back_to_back_ticks, nothing);
}

Result<void> touch_while_carving(Haptics& all, Pacing pacing) {
    MonotonicClock clock;
    const BumpySphere ball{.bumps = 0.0};
    Result<compute::Solid> solid =
        compute::make_ball(ball.radius_m, all.options.solid_resolution, geometry::Material{});
    if (!solid) return std::unexpected(solid.error());
    TickCosts& costs = all.ticks.emplace_back();
    costs.scene = "carving", costs.probe = "ball_2_mm", costs.pacing = name_of(pacing);
    Run run(costs, clock, haptics::ball_probe(Carver::kTool_m), ball);
    Carver carver(std::move(*solid), run.channels(), run.hip_m());
    costs.triangles = carver.triangles();
    if (pacing != Pacing::back_to_back) {
        CarvingThread thread(carver);
        run.paced(all.options.paced_ticks, pacing == Pacing::paced);
        return thread.stop();
    }
    Result<void> done;
    run.back_to_back(all.options.back_to_back_ticks, [&](std::uint64_t i) {
        if (done && i % kTicksAnUpdate == 0) done = carver.update();
    });
    return done;
}

}  // namespace

Result<void> measure_ticks(Haptics& all, const Tell& log_progress) {
    for (const std::size_t size : all.options.sizes) {
        auto mesh = geometry::TouchMesh::create(mesh_of({}, squares_for(size)));
        if (!mesh) return std::unexpected(mesh.error());
        const auto snapshot = mesh->snapshot();
        for (const NamedProbe& probe : all_probes())
            for (const Pacing pacing : kPacings) {
                log_progress("ticks on " + std::to_string(snapshot->triangles()) + " triangles, " + probe.name + ", " +
                             name_of(pacing));
                touch_sphere(all, snapshot, probe, pacing);
            }
    }
    for (const Pacing pacing : kPacings) {
        log_progress("ticks under carving, " + name_of(pacing));
        if (auto done = touch_while_carving(all, pacing); !done) return done;
    }
    return {};
}

}  // namespace burin::bench
