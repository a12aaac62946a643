// SPDX-License-Identifier: MIT
#include "bench/engines/engine_check.hpp"

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <utility>

#include "base/try.hpp"
#include "base/worker_pool.hpp"
#include "bench/engines/followed_surface.hpp"
#include "bench/engines/random_work.hpp"
#include "compute/engine/history.hpp"
#include "compute/vulkan/vulkan_engine.hpp"
#include "gpu/device.hpp"

namespace burin::bench {
namespace {

using shared::DexelEnd;

// A solid on which so much was done is like any other that long: begin with another one.
constexpr std::size_t kOperationsASolid = 250;

std::span<const DexelEnd> ends_of(const compute::Solid& solid, std::uint32_t ray_code) {
    const compute::RayPlace place = compute::place_of(ray_code);
    return solid.sets.at(static_cast<std::size_t>(place.axis)).ends(place.u, place.v);
}

bool same_end(const DexelEnd& a, const DexelEnd& b) {
    return a.depth_material == b.depth_material && a.normal == b.normal;
}

std::uint64_t ends_that_differ(std::span<const DexelEnd> a, std::span<const DexelEnd> b) {
    const std::size_t both = std::min(a.size(), b.size());
    std::uint64_t differ = std::max(a.size(), b.size()) - both;
    for (std::size_t i = 0; i < both; ++i) differ += same_end(a[i], b[i]) ? 0 : 1;
    return differ;
}

std::string text_of_ends(std::span<const DexelEnd> ends) {
    std::string text;
    for (const DexelEnd& end : ends)
        text += " " + std::to_string(depth_of(end)) + "/" + std::to_string(material_of(end)) + "/" +
                std::to_string(end.normal);
    return text.empty() ? " none" : text;
}

// One solid in both engines, and what was compared of it.
class SideBySide {
public:
    SideBySide(std::unique_ptr<compute::CarvingEngine> cpu, std::unique_ptr<compute::CarvingEngine> other,
               WorkerPool& pool, EngineCheck& check)
        : cpu_(std::move(cpu)),
          other_(std::move(other)),
          surface_(cpu_->solid(), pool),
          check_(check),
          start_(cpu_->solid()) {
        other_->make_cells();
    }

    [[nodiscard]] const compute::Lattice& lattice() const { return start_.lattice; }

    Result<void> perform(const RandomStep& step) {
        ComparedWork& work = check_.work[static_cast<std::size_t>(step.kind)];
        const std::uint64_t before = submissions();
        if (step.updates.empty()) {
            BURIN_TRY_DO(walk(step.kind == RandomKind::undo, work));
        } else {
            BURIN_TRY_DO(carve(step.updates, work));
        }
        if (step.ends_stroke) {
            cpu_history_.end_stroke();
            other_history_.end_stroke();
        }
        work.submissions += submissions() - before;
        return {};
    }

    // Compares all rays, undoes all that the histories hold, and compares all rays with those of the beginning.
    Result<void> finish() {
        compare_all(cpu_->solid());
        ComparedWork& work = check_.work[static_cast<std::size_t>(RandomKind::undo)];
        while (cpu_history_.undoable() > 0) BURIN_TRY_DO(walk(true, work));
        compare_all(start_);
        for (std::string& notice : other_->take_notices())
            if (std::ranges::find(check_.notices, notice) == check_.notices.end())
                check_.notices.push_back(std::move(notice));
        return {};
    }

private:
    [[nodiscard]] std::uint64_t submissions() const {
        const std::optional<compute::DeviceTraffic> traffic = other_->traffic();
        return traffic ? traffic->submissions : 0;
    }

    // Begins all updates on the device; the processor follows by as many as the device has done together.
    Result<void> carve(const std::vector<std::vector<compute::ToolSweep>>& updates, ComparedWork& work) {
        const compute::Wait wait = updates.size() > 1 ? compute::Wait::briefly : compute::Wait::yes;
        compute::Ticket last = 0;
        for (const std::vector<compute::ToolSweep>& update : updates) {
            BURIN_TRY(ticket, other_->begin(update));
            last = ticket;
        }
        std::size_t done = 0;
        while (other_->under_way() > 0) {
            BURIN_TRY(taken, other_->take(wait));
            if (!taken) continue;
            const std::size_t until = updates.size() - static_cast<std::size_t>(last - taken->ticket);
            for (; done < until; ++done) BURIN_TRY_DO(cpu_->carve(updates[done]));
            compare_changed(taken->changes, work, true);
            compare_surface(*taken, work);
        }
        work.operations += updates.size();
        return mend(true);
    }

    // Undoes or repeats a stroke, where there is one.
    Result<void> walk(bool back, ComparedWork& work) {
        for (const auto& [history, engine] :
             {std::pair<compute::History*, compute::CarvingEngine*>{&cpu_history_, &*cpu_},
              {&other_history_, &*other_}})
            BURIN_TRY_DO(back ? history->undo(*engine) : history->redo(*engine));
        ++work.operations;
        const compute::Changes walked = other_->take_changes();
        surface_.follow(other_->solid(), walked);
        compare_changed(walked, work, false);
        return mend(false);
    }

    void compare_surface(const compute::Delta& delta, ComparedWork& work) {
        const ComparedSurface compared = surface_.follow(other_->solid(), delta);
        work.elements += compared.elements;
        work.elements_that_differ += compared.differ;
        if (check_.first_element_that_differs.empty() && compared.differ > 0)
            check_.first_element_that_differs =
                work.name + ", solid " + std::to_string(check_.solids) + ", " + compared.first;
    }

    // Compares the rays that either engine has changed.
    void compare_changed(const compute::Changes& of_other, ComparedWork& work, bool record) {
        const compute::Changes of_cpu = cpu_->take_changes();
        if (record) {
            cpu_history_.record(of_cpu);
            other_history_.record(of_other);
        }
        std::set<std::uint32_t> codes;
        for (const shared::ChangedRay& ray : of_cpu.rays) codes.insert(ray.ray);
        for (const shared::ChangedRay& ray : of_other.rays) codes.insert(ray.ray);
        for (const std::uint32_t code : codes)
            if (!compare(code, cpu_->solid(), work)) wrong_.insert(code);
    }

    // Gives the device the processor's ends where its own differed, once nothing is under way. Its history learns of
    // rays that it should have changed and did not.
    Result<void> mend(bool record) {
        compute::RayBatch right;
        for (const std::uint32_t code : std::exchange(wrong_, {})) right.add(code, ends_of(cpu_->solid(), code));
        if (right.rays.empty()) return {};
        BURIN_TRY_DO(other_->assign(right));
        const compute::Changes mended = other_->take_changes();
        surface_.follow(other_->solid(), mended);
        if (record) other_history_.record(mended);
        return {};
    }

    // Returns whether the device's ray is as expected.
    bool compare(std::uint32_t code, const compute::Solid& expected, ComparedWork& work) {
        const auto right = ends_of(expected, code), held = ends_of(other_->solid(), code);
        const std::uint64_t differ = ends_that_differ(right, held);
        ++work.rays;
        work.ends += std::max(right.size(), held.size());
        work.ends_that_differ += differ;
        if (differ > 0 && check_.first_difference.empty()) {
            const compute::RayPlace place = compute::place_of(code);
            check_.first_difference = work.name + ", solid " + std::to_string(check_.solids) + ": ray " +
                                      std::to_string(place.u) + ", " + std::to_string(place.v) + " along " +
                                      "xyz"[place.axis] + " has the ends (depth/material/normal)" + text_of_ends(held) +
                                      ", the processor's" + text_of_ends(right);
        }
        return differ == 0;
    }

    void compare_all(const compute::Solid& expected) {
        ComparedWork& work = check_.work.back();
        const compute::Lattice& lattice = expected.lattice;
        for (int axis = 0; axis < 3; ++axis)
            for (int v = 0; v < lattice.rays_v(axis); ++v)
                for (int u = 0; u < lattice.rays_u(axis); ++u) compare(shared::ray_code(axis, u, v), expected, work);
        ++work.operations;
    }

    std::unique_ptr<compute::CarvingEngine> cpu_;
    std::unique_ptr<compute::CarvingEngine> other_;
    compute::History cpu_history_, other_history_;
    FollowedSurface surface_;
    EngineCheck& check_;
    compute::Solid start_;
    std::set<std::uint32_t> wrong_;  // codes of rays that differed and were not mended
};

}  // namespace

ComparedWork& ComparedWork::operator+=(const ComparedWork& other) {
    operations += other.operations;
    submissions += other.submissions;
    rays += other.rays;
    ends += other.ends;
    ends_that_differ += other.ends_that_differ;
    elements += other.elements;
    elements_that_differ += other.elements_that_differ;
    return *this;
}

Result<EngineCheck> compare_engines(const EngineCheckOptions& options, const MakeCompared& make) {
    WorkerPool pool(options.threads);
    EngineCheck check;
    check.options = options;
    check.threads = pool.threads();
    for (std::size_t i = 0; i < kRandomKinds; ++i) check.work.push_back({.name = name_of(static_cast<RandomKind>(i))});
    check.work.push_back({.name = "all rays of a solid"});
    RandomWork random(options.seed);
    for (std::size_t left = options.operations; left > 0;) {
        BURIN_TRY(solid, random.solid(options.resolution));
        BURIN_TRY(other, make(solid, pool));
        SideBySide both(compute::make_cpu_engine(std::move(solid), pool), std::move(other), pool, check);
        ++check.solids;
        std::size_t now = std::min(left, kOperationsASolid);
        left -= now;
        while (now > 0) {
            BURIN_TRY(step, random.step(both.lattice()));
            if (step.updates.size() > now) step.updates.resize(now);
            BURIN_TRY_DO(both.perform(step));
            now -= std::max<std::size_t>(1, step.updates.size());
        }
        BURIN_TRY_DO(both.finish());
    }
    for (const ComparedWork& work : check.work) check.all += work;
    std::ranges::stable_sort(check.work, std::greater(), [](const ComparedWork& work) {
        return std::pair(work.ends_that_differ, work.elements_that_differ);
    });
    return check;
}

Result<EngineCheck> check_device(const EngineCheckOptions& options) {
    BURIN_TRY(device, gpu::Device::create({.index = options.device}));
    const auto make = [&device](compute::Solid solid,
                                WorkerPool& pool) -> Result<std::unique_ptr<compute::CarvingEngine>> {
        Result<std::unique_ptr<compute::CarvingEngine>> made =
            compute::VulkanEngine::create(std::move(solid), device, pool);
        if (!made) made.error().remedy = "choose another device with --device, of those that burin --version lists";
        return made;
    };
    BURIN_TRY(check, compare_engines(options, make));
    check.device = device.info().name;
    check.driver = device.info().driver;
    check.software_device = device.info().is_software();
    const gpu::WorkAsked asked = device.asked();
    check.traffic = {asked.submissions,       asked.blocking_waits,
                     asked.bytes_to_device,   asked.bytes_to_host + asked.bytes_written_to_host,
                     asked.most_memory_bytes, asked.bytes_written_to_host};
    return std::move(check);
}

}  // namespace burin::bench
