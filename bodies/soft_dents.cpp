// SPDX-License-Identifier: MIT
#include "bodies/soft_dents.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <span>
#include <string>
#include <utility>

#include "base/try.hpp"
#include "bodies/soft_part.hpp"

namespace burin::bodies {
namespace {

using scene::StepWay;

constexpr const char *kHead = "head", *kShape = "shape";
constexpr double kFarthest_m = 10.0, kMostMetric = 1e6;  // beyond these no body is sound

static_assert(sizeof(Vec3) == 3 * sizeof(double) && sizeof(glm::dmat3) == 9 * sizeof(double), "without gaps");

std::array<double, 10> numbers_of(const SoftPartSetup& setup) {
    const SoftMaterial& m = setup.material;
    return {setup.half_axes_m.x, setup.half_axes_m.y, setup.half_axes_m.z, setup.spacing_m, m.young_Pa,
            m.poisson,           m.density_kg_per_m3, m.damping_s,         m.yield_Pa,      m.relaxes_s};
}

template <typename Value>
std::vector<std::byte> bytes_of(std::span<const Value> values) {
    const auto bytes = std::as_bytes(values);
    return {bytes.begin(), bytes.end()};
}

std::vector<std::byte> bytes_of(const SoftShapeKept& shape) {
    const std::array counts{static_cast<std::uint32_t>(shape.places_m.size()),
                            static_cast<std::uint32_t>(shape.metrics.size())};
    std::vector<std::byte> all = bytes_of(std::span<const std::uint32_t>(counts));
    for (const auto& part :
         {bytes_of(std::span<const Vec3>(shape.places_m)), bytes_of(std::span<const Vec3>(shape.held_at_m)),
          bytes_of(std::span<const glm::dmat3>(shape.metrics))})
        all.insert(all.end(), part.begin(), part.end());
    return all;
}

template <typename Value>
std::vector<Value> taken(std::span<const std::byte>& from, std::size_t count) {
    std::vector<Value> values(count);
    if (count > 0) std::memcpy(values.data(), from.data(), count * sizeof(Value));
    from = from.subspan(count * sizeof(Value));
    return values;
}

bool is_sound(const SoftShapeKept& shape) {
    const auto is_near = [](const Vec3& place_m) { return finite(place_m) && glm::length(place_m) < kFarthest_m; };
    // A metric is symmetric and positive, of the determinant 1.
    const auto is_metric = [](const glm::dmat3& metric) {
        for (int i = 0; i < 3; ++i)
            if (!finite(metric[i]) || glm::length(metric[i]) > kMostMetric || !(metric[i][i] > 0.0)) return false;
        return std::abs(glm::determinant(metric) - 1.0) < 1e-3;
    };
    return std::ranges::all_of(shape.places_m, is_near) && std::ranges::all_of(shape.held_at_m, is_near) &&
           std::ranges::all_of(shape.metrics, is_metric);
}

}  // namespace

// ---- Steps

void SoftDents::begin(SoftShapeKept now) {
    if (open_) return;
    undone_.clear();
    const scene::PartSteps left = steps();
    for (auto* const all : {&unsaved_, &unnoted_}) all->erase(all->upper_bound(left.done), all->end());
    open_ = std::move(now);
    ++made_;
}

void SoftDents::end() {
    if (open_) add(*std::exchange(open_, std::nullopt));
}

void SoftDents::add(SoftShapeKept before) {
    done_.push_back(std::move(before));
    is_new(steps().done);
    if (done_.size() <= kMostSteps) return;
    done_.pop_front();
    unsaved_.erase(first_);
    unnoted_.erase(first_++);
}

void SoftDents::is_new(std::int64_t step) {
    unsaved_.insert(step);
    unnoted_.insert(step);
}

const SoftShapeKept* SoftDents::next(StepWay way) const {
    if (way == StepWay::back && open_) return &*open_;
    const auto& from = way == StepWay::back ? done_ : undone_;
    return way == StepWay::forget || from.empty() ? nullptr : &from.back();
}

std::optional<SoftShapeKept> SoftDents::go(StepWay way, SoftShapeKept now) {
    if (way == StepWay::forget) {
        undone_.clear();
        return std::nullopt;
    }
    end();
    auto &from = way == StepWay::back ? done_ : undone_, &to = way == StepWay::back ? undone_ : done_;
    if (from.empty()) return std::nullopt;
    SoftShapeKept given = std::move(from.back());
    from.pop_back();
    to.push_back(std::move(now));
    is_new(way == StepWay::back ? steps().done + 1 : steps().done);
    return given;
}

scene::PartSteps SoftDents::steps() const {
    const std::int64_t done = first_ + static_cast<std::int64_t>(done_.size()) - (open_ ? 0 : 1);
    return {.first = first_, .done = done, .last = done + static_cast<std::int64_t>(undone_.size()), .made = made_};
}

// ---- Pages

void SoftDents::save(scene::Pages& pages) {
    end();
    put(unsaved_, pages);
}

void SoftDents::note(scene::Pages& pages) { put(unnoted_, pages); }

void SoftDents::put(std::set<std::int64_t>& which, scene::Pages& pages) const {
    const scene::PartSteps now = steps();
    pages.steps = {.first = now.first, .done = now.done, .last = now.last};
    for (std::int64_t number = now.first; number <= now.last; ++number) {
        if (!pages.whole && !which.contains(number)) continue;
        const SoftShapeKept& shape = number <= now.done ? done_[static_cast<std::size_t>(number - now.first)]
                                                        : undone_[static_cast<std::size_t>(now.last - number)];
        pages.steps->pages[{kShape, number}] = bytes_of(shape);
    }
    which.clear();
}

void SoftDents::load(const scene::Steps& steps, std::vector<SoftShapeKept> shapes) {
    *this = {};
    first_ = steps.first;
    const auto back = static_cast<std::size_t>(steps.done - steps.first + 1);
    for (std::size_t i = 0; i < shapes.size(); ++i)
        i < back ? done_.push_back(std::move(shapes[i])) : undone_.push_front(std::move(shapes[i]));
}

void save_body(const SoftPartSetup& setup, const SoftShapeKept& shape, scene::Pages& pages) {
    pages.part = kSoftBodyPart;
    pages.pages[{kHead, 0}] = bytes_of(std::span<const double>(numbers_of(setup)));
    pages.pages[{kShape, 0}] = bytes_of(shape);
}

Result<SoftShapeKept> shape_in(const SoftBody& body, const scene::Pages& pages, const std::string& where) {
    const auto damaged = [&] { return fail(where, "the shape of its soft body is damaged", "open an earlier copy"); };
    const std::vector<std::byte>* const bytes = pages.find({kShape, 0});
    const std::size_t corners = body.corners(), cells = body.at_rest().flow.metrics.size();
    if (bytes == nullptr ||
        bytes->size() != 2 * sizeof(std::uint32_t) + 2 * corners * sizeof(Vec3) + cells * sizeof(glm::dmat3))
        return damaged();
    std::span<const std::byte> left = *bytes;
    const auto counts = taken<std::uint32_t>(left, 2);
    if (counts[0] != corners || counts[1] != cells) return damaged();
    SoftShapeKept shape;
    shape.places_m = taken<Vec3>(left, corners);
    shape.held_at_m = taken<Vec3>(left, corners);
    shape.metrics = taken<glm::dmat3>(left, cells);
    if (!is_sound(shape)) return damaged();
    return shape;
}

Result<SoftShapeKept> load_body(const SoftPartSetup& setup, const SoftBody& body, const scene::Pages& pages,
                                const std::string& where) {
    const std::vector<std::byte>* const head = pages.find({kHead, 0});
    if (pages.part != kSoftBodyPart || head == nullptr || *head != bytes_of(std::span<const double>(numbers_of(setup))))
        return fail(where, "holds another soft body than this one", "open it with the settings that it was made with");
    return shape_in(body, pages, where);
}

}  // namespace burin::bodies
