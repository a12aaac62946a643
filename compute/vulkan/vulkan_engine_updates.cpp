// SPDX-License-Identifier: MIT
// Updates of the Vulkan engine: which of them the device carries out, and when.
#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

#include "base/try.hpp"
#include "compute/tools/apply.hpp"
#include "compute/tools/tool_spans.hpp"
#include "compute/vulkan/vulkan_engine.hpp"

namespace burin::compute {
namespace {

using shared::Capsule;
using shared::ChangedRay;
using shared::CutCounters;
using shared::CutParameters;
using shared::CutTask;
using shared::DexelEnd;
using shared::PendingRay;
using shared::SmoothParameters;
using shared::SmoothTask;

// Rays that one pass visits, of as many work groups as every device takes; more of them are left to the host, for which
// that is work enough.
constexpr std::uint32_t kMostVisited = 65535u * shared::kCutGroup;

bool is_convex_cut(const ToolSweep& sweep) {
    return !std::holds_alternative<BallTool>(sweep.shape) && !std::holds_alternative<MeshTool>(sweep.shape) &&
           sweep.operation != Operation::smooth;
}

bool is_smoothing(const ToolSweep& sweep) { return sweep.operation == Operation::smooth; }

template <typename T>
std::span<const T> from(const std::vector<T>& values, std::size_t first) {
    return std::span(values).subspan(first);
}

}  // namespace

Result<Ticket> VulkanEngine::begin(std::span<const ToolSweep> sweeps) {
    for (const ToolSweep& sweep : sweeps) BURIN_TRY_DO(check_tool(solid_, sweep));
    if (no_cover_) tell_what_is_not_covered(sweeps);
    waiting_.push_back({std::vector(sweeps.begin(), sweeps.end()), {}});
    ++begun_;
    if (!flight_) start(Wait::yes);
    return begun_;
}

Result<Ticket> VulkanEngine::begin(RayBatch rays) {
    waiting_.push_back({{}, std::move(rays)});
    return ++begun_;
}

Result<std::optional<Delta>> VulkanEngine::take(Wait wait) {
    if (failure_) return std::unexpected(forgotten(*std::exchange(failure_, std::nullopt)));
    if (!flight_ && waiting_.empty()) return std::nullopt;
    if (flight_) {
        if (const auto advanced = advance(wait); !advanced) return std::unexpected(forgotten(advanced.error()));
        if (!flight_->is_done()) return std::nullopt;
    }
    Result<Delta> delta = flight_ ? land() : carry_out_on_host();
    if (!delta) return std::unexpected(forgotten(delta.error()));
    start(wait);
    return std::move(*delta);
}

bool VulkanEngine::is_for_device(const ToolSweep& sweep) const {
    return is_ball_cut(sweep) || (covered_ && is_convex_cut(sweep)) || (smooths_ && is_smoothing(sweep));
}

void VulkanEngine::tell_what_is_not_covered(std::span<const ToolSweep> sweeps) {
    if (std::ranges::none_of(sweeps, [](const auto& sweep) { return is_convex_cut(sweep) || is_smoothing(sweep); }))
        return;
    notices_.push_back(Error{no_cover_->what, no_cover_->where, ""}.line() +
                       "; the processor smooths, and computes what cylinders, cones, bull-noses and boxes cover");
    no_cover_.reset();
}

// Returns how many of the sweeps, from the first on, have shaders.
std::size_t VulkanEngine::for_device(std::span<const ToolSweep> sweeps) const {
    const auto first = std::ranges::find_if_not(sweeps, [this](const auto& sweep) { return is_for_device(sweep); });
    return static_cast<std::size_t>(first - sweeps.begin());
}

// Lets the device begin with what comes next: one update, or several as one, which end with what the host does.
void VulkanEngine::start(Wait alone) {
    if (failure_ || waiting_.empty() || for_device(waiting_.front().sweeps) == 0) return;
    std::vector<ToolSweep> sweeps;
    std::size_t updates = 0;
    bool goes_on = true;
    do {
        std::vector<ToolSweep>& next = waiting_.front().sweeps;
        goes_on = alone != Wait::yes && for_device(next) == next.size();
        std::ranges::move(next, std::back_inserter(sweeps));
        waiting_.pop_front();
        ++updates;
    } while (goes_on && !waiting_.empty() && for_device(waiting_.front().sweeps) > 0);
    auto started = prepare(std::move(sweeps));
    if (started) {
        flight_->updates = updates;
        started = advance(Wait::no);
    }
    if (!started) failure_ = started.error();
}

// ---- On the device

Result<void> VulkanEngine::prepare(std::vector<ToolSweep> sweeps) {
    flight_.emplace();
    changed_rays_.clear();
    new_ends_.clear();
    flight_->sweeps = std::move(sweeps);
    flight_->on_host = for_device(flight_->sweeps);
    for (std::size_t i = 0, end = 0; i < flight_->on_host; i = end) {
        end = i + 1;
        if (is_ball_cut(flight_->sweeps[i]))
            while (end < flight_->on_host && is_ball_cut(flight_->sweeps[end])) ++end;
        BURIN_TRY(fits, add_stage(i, end));
        if (!fits) flight_->on_host = i;
    }
    if (flight_->stages.empty()) return {};
    ++counts_.cuts;
    BURIN_TRY_DO(prepare_patches());
    BURIN_TRY_DO(capsules_.reserve(device_, std::max<std::size_t>(flight_->capsules.size(), 1) * sizeof(Capsule)));
    BURIN_TRY_DO(
        order_.reserve(device_, std::max<std::size_t>(flight_->tasks.order.size(), 1) * sizeof(std::uint32_t)));
    return counters_.reserve(device_, sizeof(CutCounters));
}

// Has the device hold what the host does: at once where much is to be sent, else with the first submission.
Result<void> VulkanEngine::prepare_patches() {
    if (!synchronized_ || assigned_.empty()) return synchronize();
    RayBatch rays = take_assigned();
    if (rays.rays.size() > most_patches() || rays.ends.size() > most_patch_ends()) {
        const auto patched = patch(rays);
        if (!patched) synchronized_ = false;
        return patched;
    }
    for (const RayBatch::Ray& ray : rays.rays) flight_->patches.push_back({ray.code, ray.first, ray.count});
    flight_->patch_ends = std::move(rays.ends);
    return reserve_patches(flight_->patches.size(), flight_->patch_ends.size());
}

// Adds balls, or one other tool, to the flight. Returns false where that is beyond the device.
Result<bool> VulkanEngine::add_stage(std::size_t first_sweep, std::size_t end_sweep) {
    const auto sweeps = std::span(flight_->sweeps).subspan(first_sweep, end_sweep - first_sweep);
    if (is_smoothing(sweeps[0])) return add_smoothing(first_sweep);
    Stage stage{.first_sweep = first_sweep, .pieces = {}, .smooths = {}};
    if (!is_ball_cut(sweeps[0])) {
        const ToolSweep& sweep = sweeps[0];
        BURIN_TRY(pieces, convex_pieces(solid_.lattice, sweep));
        if (pieces.pieces.empty()) return true;  // it comes nowhere near the lattice
        BURIN_TRY(fits, covered_->prepare(solid_.lattice, pieces));
        stage.visited = covered_->ray_count();
        if (!fits || stage.visited > kMostVisited) return false;
        stage.pieces = std::move(pieces);
        stage.work = sweep.material | static_cast<std::uint32_t>(sweep.operation) << 8;
        if (stage.visited > 0) flight_->stages.push_back(std::move(stage));
        return true;
    }
    std::vector<BallSweep> balls;
    for (const ToolSweep& sweep : sweeps) balls.push_back(ball_sweep(sweep));
    BURIN_TRY(capsules, capsules_in_units(solid_, balls));
    const CutTasks tasks = cut_tasks(solid_.lattice, capsules, options_.tasks_a_pass);
    if (tasks.tasks.empty()) return true;
    CutTasks& all = flight_->tasks;
    const auto first_capsule = static_cast<std::uint32_t>(flight_->capsules.size()),
               first_place = static_cast<std::uint32_t>(all.order.size());
    stage.next_task = all.tasks.size();
    for (CutTask task : tasks.tasks) {
        task.first += first_place;
        task.end += first_place;
        all.tasks.push_back(task);
    }
    for (const std::uint32_t capsule : tasks.order) all.order.push_back(first_capsule + capsule);
    std::ranges::copy(capsules, std::back_inserter(flight_->capsules));
    stage.end_task = all.tasks.size();
    flight_->stages.push_back(std::move(stage));
    return true;
}

// Adds a sweep that smooths to the flight. Returns false where that is beyond the device.
Result<bool> VulkanEngine::add_smoothing(std::size_t of_sweep) {
    auto steps = smooth_steps(solid_.lattice, flight_->sweeps[of_sweep]);
    if (!steps) return false;
    if (steps->empty()) return true;
    if (!smooth_) {
        BURIN_TRY(made, SmoothPasses::create(device_, options_.smooth_percent));
        smooth_.emplace(std::move(made));
    }
    BURIN_TRY_DO(smooth_->prepare(*steps));
    const std::size_t balls = steps->size();
    flight_->stages.push_back({.first_sweep = of_sweep, .end_task = balls, .pieces = {}, .smooths = std::move(*steps)});
    return true;
}

// Submits what is left of the flight, as far as that needs no waiting, or all of it.
Result<void> VulkanEngine::advance(Wait wait) {
    while (!flight_->is_done()) {
        if (!flight_->submission) {
            BURIN_TRY_DO(submit_passes());
        } else if (wait != Wait::yes && !flight_->submission->done_within(wait == Wait::no ? 0 : kBriefly_ns)) {
            return {};
        } else {
            BURIN_TRY_DO(end_submission());
        }
    }
    return {};
}

Result<void> VulkanEngine::submit_passes() {
    BURIN_TRY_DO(check_longest());
    flight_->passes = flight_->next_passes(options_.tasks_a_pass, longest_);
    std::uint64_t rays = 0;
    std::vector<CutTask> tasks;
    std::vector<SmoothTask> smooths;
    for (const Pass& pass : flight_->passes) {
        rays += pass.rays;
        append_pass(flight_->tasks_of(pass), tasks);
        const Stage& stage = flight_->stages[pass.stage];
        if (stage.is_smooth()) smooths.push_back(stage.smooths[pass.first_task].task);
    }
    BURIN_TRY_DO(reserve_passes(rays, tasks.size()));
    BURIN_TRY(commands, gpu::Commands::begin(device_));
    copy_to<Capsule>(capsules_, flight_->capsules);
    copy_to<std::uint32_t>(order_, flight_->tasks.order);
    copy_to<CutTask>(tasks_, tasks);
    capsules_.send(commands, flight_->capsules.size() * sizeof(Capsule));
    order_.send(commands, flight_->tasks.order.size() * sizeof(std::uint32_t));
    tasks_.send(commands, tasks.size() * sizeof(CutTask));
    send_for_cells(commands);
    if (!smooths.empty()) BURIN_TRY_DO(smooth_->send(commands, smooths));
    send_counters(commands);
    if (!flight_->patches.empty()) record_patches(commands, flight_->patches, flight_->patch_ends);
    CutParameters parameters = this->parameters();
    // The buffer may be larger from an earlier cut, but the host does not look for more than it expects.
    parameters.export_size = static_cast<std::uint32_t>(exported_.size_bytes() / sizeof(DexelEnd));
    std::swap(pending_buffer_, continued_);
    std::uint32_t ball = 0;
    for (const Pass& pass : flight_->passes) {
        parameters.end_task = parameters.first_task + static_cast<std::uint32_t>(flight_->tasks_of(pass).size());
        if (flight_->stages[pass.stage].is_smooth())
            record_smoothing(commands, pass, ball++, parameters);
        else
            BURIN_TRY_DO(record(commands, pass, parameters));
        ++parameters.pass;
        parameters.first_task = parameters.end_task;
    }
    if (flight_->one_pass && flight_->stages[flight_->passes.front().stage].is_covered())
        covered_->fetch_counters(commands);
    if (flight_->makes_cells)
        maker_->record(commands, solid_, device_solid_, counters_.buffer(), changed_.buffer(),
                       static_cast<std::uint32_t>(rays));
    if (!smooths.empty()) smooth_->fetch(commands);
    counters_.fetch(commands, sizeof(CutCounters));
    BURIN_TRY(submission, std::move(commands).submit());
    ++counts_.submissions;
    flight_->submission.emplace(std::move(submission));
    return {};
}

// Reserves room for the case that every ray that is looked at changes, or is left pending.
Result<void> VulkanEngine::reserve_passes(std::uint64_t rays, std::uint64_t tasks) {
    const std::uint64_t exported = std::clamp<std::uint64_t>(rays * options_.export_per_ray, 1, kMostExported);
    const std::pair<SharedBuffer*, std::uint64_t> sizes[] = {
        {&tasks_, std::max<std::uint64_t>(tasks, 1) * sizeof(CutTask)},
        {&changed_, rays * sizeof(ChangedRay)},
        {&exported_, exported * sizeof(DexelEnd)},
        {&pending_buffer_, rays * sizeof(PendingRay)},
        {&continued_, rays * sizeof(PendingRay)},
    };
    for (const auto& [buffer, size] : sizes) {
        // What waits must stay, and it is in no larger buffer than it was.
        if (flight_->pending > 0 && buffer == &pending_buffer_) continue;
        BURIN_TRY_DO(buffer->reserve(device_, size));
    }
    return {};
}

Result<void> VulkanEngine::record(gpu::Commands& commands, const Pass& pass, CutParameters parameters) {
    const Stage& stage = flight_->stages[pass.stage];
    parameters.pending = pass.pending;
    parameters.cuts = pass.cuts;
    std::array<gpu::BufferRange, 3> work{capsules_.buffer(), tasks_.buffer(), order_.buffer()};
    const gpu::ComputePipeline* program = &cut_rays_;
    if (stage.is_covered()) {
        BURIN_TRY(fits, covered_->prepare(solid_.lattice, stage.pieces));
        BURIN_CHECK(fits);
        covered_->record(commands);
        program = &cut_covered_;
        work = {covered_->spans(), covered_->rays(), covered_->counters()};
        parameters.visited = stage.visited;
        parameters.work = stage.work;
    }
    commands.dispatch(*program,
                      {device_solid_.rays(), pending_buffer_.buffer(), work[0], work[1], work[2], counters_.buffer(),
                       changed_.buffer(), exported_.buffer(), continued_.buffer()},
                      gpu::bytes_of(parameters), {groups_of(pass.rays), 1, 1});
    commands.barrier();
    return {};
}

// Makes ready for the cells around what the passes change, unless the host makes them after work of its own.
void VulkanEngine::send_for_cells(gpu::Commands& commands) {
    flight_->makes_cells = maker_ != nullptr && flight_->on_host == flight_->sweeps.size() && !flight_->is_between;
    if (!flight_->makes_cells) return;
    if (const auto sent = maker_->send(commands, solid_); !sent) leave_cells_to_host(sent.error());
}

void VulkanEngine::leave_cells_to_host(const Error& why) {
    notices_.push_back(Error{why.what, why.where, ""}.line() + "; the processor makes the surface");
    maker_.reset();
    if (flight_) flight_->makes_cells = false;
}

void VulkanEngine::take_cells(const CutCounters& counters) {
    std::optional<MadeCells> made;
    if (flight_->makes_cells) made = maker_->take();
    if (counters.changed == 0) return;
    flight_->made = flight_->changing_submissions++ == 0 ? std::move(made) : std::nullopt;
}

void VulkanEngine::record_smoothing(gpu::Commands& commands, const Pass& pass, std::uint32_t ball,
                                    const CutParameters& parameters) {
    SmoothParameters smooths{};
    smooths.store_address = parameters.store_address;
    std::ranges::copy(parameters.rays_u, smooths.rays_u);
    std::ranges::copy(parameters.rays_v, smooths.rays_v);
    std::ranges::copy(parameters.first_ray, smooths.first_ray);
    smooths.store_size = parameters.store_size;
    smooths.export_size = parameters.export_size;
    smooths.pass = parameters.pass;
    smooths.ball = ball;
    smooths.most_ends = pass.most_ends;
    smooth_->record(commands, flight_->stages[pass.stage].smooths[pass.first_task], smooths,
                    {device_solid_.rays(), counters_.buffer(), changed_.buffer(), exported_.buffer()});
}

// Takes over what the submission has done, and finds where the flight goes on.
Result<void> VulkanEngine::end_submission() {
    BURIN_TRY_DO(flight_->submission->wait());
    flight_->submission.reset();
    const CutCounters counters = counters_.from_device<CutCounters>()[0];
    device_.core()->count_written_to_host(
        counters.changed * sizeof(ChangedRay) +
        std::min<std::uint64_t>(counters.exported * sizeof(DexelEnd), exported_.size_bytes()));
    flight_->stats.rays_touched += counters.touched;
    collect(counters);
    take_cells(counters);
    if (counters.left[0] > 0) return make_room_for(counters);  // for what was assigned; nothing else has begun
    flight_->patches.clear();
    std::size_t done = 0;
    while (done < flight_->passes.size() && counters.left[done + 1] == 0) ++done;
    for (std::size_t i = 0; i < done; ++i)
        counts_.balls_smoothed += flight_->stages[flight_->passes[i].stage].is_smooth() ? 1 : 0;
    const bool is_left = done < flight_->passes.size();
    if (is_left && flight_->stages[flight_->passes[done].stage].is_smooth()) {
        const std::size_t stage = flight_->passes[done].stage;
        flight_->pass(done, 0);
        BURIN_TRY(helps, smooth_->make_room());
        // Alone, it has all the exported ends that there may be.
        if (!helps || (done == 0 && counters.exported > kMostExported)) flight_->leave_to_host(stage);
    } else if (is_left && counters.uncovered[done] != 0) {
        BURIN_TRY_DO(end_uncovered(done));
    } else {
        flight_->one_pass = false;
        flight_->pass(done, is_left ? counters.left[done + 1] : 0);
    }
    return make_room_for(counters);
}

// Goes back to a pass that has not begun since it is not known what its tool covers.
Result<void> VulkanEngine::end_uncovered(std::size_t done) {
    const Pass pass = flight_->passes[done];
    flight_->pass(done, 0);
    flight_->pending = pass.pending;
    // Its rays wait where they did before: a pass that has not begun leaves none.
    if (pass.pending > 0) std::swap(pending_buffer_, continued_);
    if (!std::exchange(flight_->one_pass, true)) return {};
    BURIN_TRY(helps, covered_->make_room(covered_->counted()));
    if (!helps) flight_->leave_to_host(pass.stage);
    return {};
}

// Puts what the flight has changed into the host's solid, and lets the host do what is left.
Result<Delta> VulkanEngine::land() {
    Delta delta{taken_ += flight_->updates, flight_->stats, {}, {}};
    delta.stats.rays_changed = changed_rays_.size();
    apply_changes(delta.changes);
    Flight landed = std::move(*flight_);
    flight_.reset();
    // Cells that were made before the host does the rest are not those of what it leaves.
    if (landed.on_host == landed.sweeps.size()) delta.made = std::move(landed.made);
    if (landed.on_host < landed.sweeps.size()) {
        const auto rest = carry_out(from(landed.sweeps, landed.on_host), landed.first_ball, delta.changes);
        if (!rest) return taken_back(delta.changes, rest.error());
        delta.stats += *rest;
    }
    return delta;
}

// Gives the rays back what they held: an update of which only a part can be carried out has not been taken.
std::unexpected<Error> VulkanEngine::taken_back(const Changes& changes, const Error& why) {
    for (auto ray = changes.rays.rbegin(); ray != changes.rays.rend(); ++ray) {
        const RayPlace place = place_of(ray->ray);
        solid_.sets[static_cast<std::size_t>(place.axis)].replace(place.u, place.v, changes.before_of(*ray));
    }
    return std::unexpected(why);
}

// Forgets all updates that were not taken.
Error VulkanEngine::forgotten(const Error& why) {
    flight_.reset();
    waiting_.clear();
    taken_ = begun_;
    synchronized_ = false;
    if (smooth_) smooth_->forget();
    return with_the_other_engine(why);
}

// ---- On the host

Result<Delta> VulkanEngine::carry_out_on_host() {
    const Update update = std::move(waiting_.front());
    waiting_.pop_front();
    Delta delta{++taken_, {}, {}, {}};
    if (update.sweeps.empty()) {
        delta.stats = {update.rays.rays.size(), assign_rays(update.rays, delta.changes)};
    } else {
        const auto stats = carry_out(update.sweeps, 0, delta.changes);
        if (!stats) return taken_back(delta.changes, stats.error());
        delta.stats = *stats;
    }
    return delta;
}

// Carries out sweeps of which the first is the host's, from a ball on, and others too may be, one after the other.
Result<CarveStats> VulkanEngine::carry_out(std::span<const ToolSweep> sweeps, std::size_t first_ball,
                                           Changes& changes) {
    CarveStats stats;
    for (std::size_t i = 0; i < sweeps.size();) {
        const std::size_t together = i == 0 ? 0 : for_device(sweeps.subspan(i));
        const auto done = together > 0 ? cut_now(sweeps.subspan(i, together), changes)
                                       : apply_one(sweeps[i], i == 0 ? first_ball : 0, changes);
        if (!done) return done;
        stats += *done;
        i += std::max<std::size_t>(together, 1);
    }
    return stats;
}

Result<CarveStats> VulkanEngine::apply_one(const ToolSweep& sweep, std::size_t first_ball, Changes& changes) {
    return apply_on_host(
        solid_, sweep, pool_, [&](const RayBatch& rays) { return assign_rays(rays, changes); }, first_ball);
}

// Lets the device carry out sweeps between what the host does, and waits for it.
Result<CarveStats> VulkanEngine::cut_now(std::span<const ToolSweep> sweeps, Changes& changes) {
    BURIN_TRY_DO(prepare({sweeps.begin(), sweeps.end()}));
    flight_->is_between = true;
    BURIN_TRY_DO(advance(Wait::yes));
    BURIN_TRY(delta, land());
    changes.append(delta.changes);
    return delta.stats;
}

std::uint64_t VulkanEngine::assign_rays(const RayBatch& rays, Changes& changes) {
    std::uint64_t changed = 0;
    for (const RayBatch::Ray& ray : rays.rays) {
        const RayPlace place = place_of(ray.code);
        if (!assign_ray(solid_.sets[static_cast<std::size_t>(place.axis)], place, rays.ends_of(ray), changes)) continue;
        ++changed;
        assigned_.push_back(ray.code);
    }
    // Undo, smoothing and mesh tools assign, often many times before the next cut.
    if (assigned_.size() > solid_.rays_held()) keep_each_once(assigned_);
    return changed;
}

}  // namespace burin::compute
