// SPDX-License-Identifier: MIT
#include "renderer/surface/patch_choice.hpp"

#include <algorithm>
#include <utility>

#include "picture/frame_setup.hpp"
#include "picture/pixel_length.hpp"

namespace burin::renderer {
namespace {

// Largest error of a coarser level: below what the position of a sample can show.
constexpr double kMostPatchError_px = 0.5;
// And of a group's, of a moving picture, in its larger pixels.
constexpr double kMostMovingError_px = 0.75;
// Edge lengths up to which light is computed at vertices: all triangles up to the first, since light changes too little
// between their vertices to be seen, and smooth triangles up to the second.
constexpr double kFineEdge_px = 12.0, kSmoothEdge_px = 64.0;

// Computes the length of a pixel, in the patches' frame, at a patch's point nearest to an eye.
class PatchPixel {
public:
    PatchPixel(const picture::Picture& picture, ImageSize size) : picture_(picture), pixel_(picture, size) {}
    [[nodiscard]] double at(const PatchShape& patch) const {
        const double scale = picture_.world_from_object.scale;
        return pixel_.at(picture_.world_from_object * (picture_.lattice_origin_object + patch.center),
                         patch.radius_m * scale) /
               scale;
    }

private:
    const picture::Picture& picture_;
    picture::PixelLength pixel_;
};

// The region of the tool's ring and shadow, which are finer than any vertices: a ball, and balls swept along the light.
class ToolZone {
public:
    explicit ToolZone(const picture::Picture& picture) {
        const picture::PictureTool& tool = picture.tool;
        if (!tool.visible) return;
        there_ = true;
        const Similarity object_from_world = inverse(picture.world_from_object);
        const double scale = object_from_world.scale;
        const auto local = [&](const Vec3& p) { return object_from_world * p - picture.lattice_origin_object; };
        const double reach_m = double{shared::kToolShades} * tool.radius_m;
        const picture::Ball all = picture::ball_of(tool);
        center_ = local(tool.center_world);
        spine_ = local(tool.center_world + tool.spine_m) - center_;
        radius_m_ = double{shared::kToolNears} * tool.radius_m * scale;
        darkens_m_ = double{shared::kToolDarkens} * tool.radius_m * scale;
        from_ = local(all.center_world);
        to_ = local(all.center_world - (reach_m + all.radius_m) * picture::direction_to_light());
        shadow_radius_m_ = (all.radius_m + picture::kLightHalfAngleTangent * reach_m) * scale;
        const std::array balls = balls_of(tool);
        for (std::size_t i = 0; i < balls.size(); ++i) {
            if (balls[i].radius_m <= 0.0) continue;
            // Twice the ball's radius: its points lie before and behind its middle, as seen from the lamp.
            const double edge_m =
                picture::kLightHalfAngleTangent * (reach_m + 2.0 * balls[i].radius_m) + 0.02 * tool.radius_m;
            shadows_[i] = {local(balls[i].center_world), (balls[i].radius_m + edge_m) * scale};
        }
        along_ = local(tool.center_world - reach_m * picture::direction_to_light()) - center_;
    }
    // Returns whether the tool touches() the patch or occludes ambient light on it.
    [[nodiscard]] bool changes(const PatchShape& patch) const {
        if (!there_) return false;
        return distance_to_spine(patch) <= darkens_m_ || touches(patch);
    }
    [[nodiscard]] bool touches(const PatchShape& patch) const {
        if (!there_) return false;
        if (near(patch, center_, spine_, radius_m_)) return true;
        // Tests the swept bound of all shadows before each shadow by itself.
        if (!near(patch, from_, to_ - from_, shadow_radius_m_)) return false;
        return std::ranges::any_of(
            shadows_, [&](const Shadow& s) { return s.radius_m > 0.0 && near(patch, s.from, along_, s.radius_m); });
    }

private:
    struct Shadow {
        Vec3 from{0.0};
        double radius_m = 0.0;
    };
    static bool near(const PatchShape& patch, const Vec3& from, const Vec3& along, double radius_m) {
        const double t =
            std::clamp(glm::dot(patch.center - from, along) / std::max(glm::dot(along, along), 1e-300), 0.0, 1.0);
        return glm::length(from + t * along - patch.center) <= patch.radius_m + radius_m;
    }
    // Returns a distance of the patch's bounds from the spine that is never too large; a ball's is exact.
    [[nodiscard]] double distance_to_spine(const PatchShape& patch) const {
        const Box& box = patch.bounds;
        const Vec3 lo = glm::min(center_, center_ + spine_), hi = glm::max(center_, center_ + spine_);
        return glm::length(glm::max(glm::max(box.lo - hi, lo - box.hi), Vec3(0.0)));
    }

    bool there_ = false;
    Vec3 center_{0.0}, spine_{0.0}, from_{0.0}, to_{0.0}, along_{0.0};
    double radius_m_ = 0.0, darkens_m_ = 0.0, shadow_radius_m_ = 0.0;
    std::array<Shadow, picture::kSpineBalls + picture::kStylusBalls> shadows_;  // of the tool's balls
};

ShadingRate rate_of(const PatchStore::Patch& patch, const PatchPixel& pixel, const ToolZone& zone,
                    const Savings& savings) {
    if (!savings.vertex_rate || zone.touches(patch.shape)) return ShadingRate::pixel;
    const double edge_px = patch.shape.edge_m / pixel.at(patch.shape);
    if (edge_px <= kFineEdge_px) return ShadingRate::vertex;
    return edge_px <= kSmoothEdge_px ? ShadingRate::by_triangle : ShadingRate::pixel;
}

// What both eyes see of the patches through a part of the picture. Whether the fade bends a patch is asked once of
// each.
class Sight {
public:
    Sight(const EyePair& eyes, std::span<const Box> occluders, std::span<PatchStore::Patch* const> patches)
        : eyes_(eyes), occluders_(occluders) {
        if (!eyes_.fade) return;
        bent_.reserve(patches.size());
        for (const PatchStore::Patch* patch : patches) bent_.push_back(bent(eyes_, patch->shape.bounds));
        // Bent patches may uncover what is behind them.
        if (std::ranges::find(bent_, true) != bent_.end()) occluders_ = {};
    }
    // Of the patch at this place among the patches.
    [[nodiscard]] bool is_bent(std::size_t place) const { return !bent_.empty() && bent_[place]; }
    [[nodiscard]] Hidden why_hidden(std::size_t place, const PatchShape& patch) const {
        return hidden(eyes_, patch, occluders_, is_bent(place));
    }

private:
    EyePair eyes_;
    std::span<const Box> occluders_;
    std::vector<bool> bent_;  // empty: none
};

std::uint8_t level_of(const PatchStore::Patch& patch, const PatchPixel& pixel) {
    const double most_m = kMostPatchError_px * pixel.at(patch.shape);
    std::uint8_t level = 0;
    for (std::size_t i = 1; i < patch.levels.size(); ++i)
        if (patch.levels[i].error_m <= most_m) level = static_cast<std::uint8_t>(i);
    return level;
}

void append(std::vector<DrawRange>& draws, std::uint32_t first, std::uint32_t count) {
    if (count == 0) return;
    if (!draws.empty() && draws.back().first_index + draws.back().index_count == first) {
        draws.back().index_count += count;
    } else {
        draws.push_back({first, count});
    }
}

std::uint32_t lit_at_vertices(const PatchStore::Level& level, ShadingRate rate) {
    switch (rate) {
        case ShadingRate::vertex: return level.index_count;
        case ShadingRate::by_triangle: return level.smooth_count;
        case ShadingRate::pixel: return 0;
    }
    return 0;
}

// Returns the coarsest level of a group whose error a moving picture does not show; null where there is none.
const PatchGroup::Level* level_of(const PatchGroup& group, const PatchPixel& pixel) {
    const double most_m = kMostMovingError_px * pixel.at(group.shape);
    const PatchGroup::Level* found = nullptr;
    for (const PatchGroup::Level& level : group.levels)
        if (level.error_m <= most_m) found = &level;
    return found;
}

bool spared(Hidden reason, const Savings& savings, PatchCounts& counts) {
    switch (reason) {
        case Hidden::no: return false;
        case Hidden::beside: counts.beside += savings.cull_beside ? 1 : 0; return savings.cull_beside;
        case Hidden::turned_away:
            counts.turned_away += savings.cull_turned_away ? 1 : 0;
            return savings.cull_turned_away;
        case Hidden::behind: counts.behind += savings.cull_behind ? 1 : 0; return savings.cull_behind;
    }
    return false;
}

// Draws the groups that have a level for the purpose. Returns them, hidden ones too, in the order of their addresses.
std::vector<const PatchGroup*> draw_groups(PatchDraws& draws, const DrawnPatches& drawn,
                                           const picture::Picture& picture, ImageSize size, const EyePair& eyes,
                                           std::span<const Box> occluders, const Savings& savings) {
    const PatchPixel pixel(picture, size);
    const ToolZone zone(picture);
    std::vector<const PatchGroup*> groups;
    for (const auto& [place, group] : drawn.groups()) {
        const PatchGroup::Level* const level = level_of(group, pixel);
        if (level == nullptr) continue;
        groups.push_back(&group);
        if (spared(hidden(eyes, group.shape, occluders), savings, draws.counts)) continue;
        append(zone.touches(group.shape) ? draws.solid : draws.fine, level->first_index, level->index_count);
        ++draws.counts.groups;
        draws.counts.triangles += level->index_count / 3;
    }
    std::ranges::sort(groups);
    return groups;
}

}  // namespace

void choose_levels(DrawnPatches& drawn, const picture::Picture& picture, ImageSize size, const Savings& savings,
                   std::span<const Box> occluders) {
    const PatchPixel pixel(picture, size);
    const ToolZone zone(picture);
    const std::span<PatchStore::Patch* const> patches = drawn.patches();
    const Sight sight(eye_frusta(picture, size, all_of(size)), occluders, patches);
    for (std::size_t i = 0; i < patches.size(); ++i) {
        const PatchStore::Patch& patch = *patches[i];
        // The fade is computed at vertices, so where it bends the picture all of them are needed.
        const bool coarser = savings.coarser_levels && !sight.is_bent(i);
        drawn.of(patch) = {.level = coarser ? level_of(patch, pixel) : std::uint8_t{0},
                           .rate = rate_of(patch, pixel, zone, savings),
                           .wanted = savings.coarser_levels && sight.why_hidden(i, patch.shape) == Hidden::no};
    }
    drawn.levels_chosen();
}

std::vector<Box> choose_rates(DrawnPatches& drawn, const picture::Picture& picture, ImageSize size,
                              const Savings& savings) {
    const PatchPixel pixel(picture, size);
    const ToolZone zone(picture);
    std::vector<Box> changed;
    for (const PatchStore::Patch* patch : drawn.patches()) {
        const ShadingRate rate = rate_of(*patch, pixel, zone, savings);
        if (std::exchange(drawn.of(*patch).rate, rate) == rate) continue;
        changed.push_back(patch->shape.bounds);
    }
    return changed;
}

std::vector<Box> changed_near_tool(std::span<PatchStore::Patch* const> patches, const picture::Picture& before,
                                   const picture::Picture& now, ImageSize size, std::span<const Box> occluders) {
    std::vector<Box> changed;
    if (before.tool == now.tool) return changed;
    const ToolZone was(before), is(now);
    const Sight sight(eye_frusta(now, size, all_of(size)), occluders, patches);
    for (std::size_t i = 0; i < patches.size(); ++i) {
        const PatchShape& shape = patches[i]->shape;
        if ((was.changes(shape) || is.changes(shape)) && sight.why_hidden(i, shape) == Hidden::no)
            changed.push_back(shape.bounds);
    }
    return changed;
}

PatchDraws choose_draws(const DrawnPatches& drawn, const picture::Picture& picture, ImageSize size,
                        const PixelRect& part, const Savings& savings, std::span<const Box> occluders, bool moving) {
    PatchDraws draws;
    const std::span<PatchStore::Patch* const> patches = drawn.patches();
    const EyePair eyes = eye_frusta(picture, size, part);
    const Sight sight(eyes, occluders, patches);
    std::vector<const PatchGroup*> groups;
    if (moving && !eyes.fade) groups = draw_groups(draws, drawn, picture, size, eyes, occluders, savings);
    for (std::size_t i = 0; i < patches.size(); ++i) {
        const PatchStore::Patch& patch = *patches[i];
        if (std::ranges::binary_search(groups, static_cast<const PatchGroup*>(patch.group))) continue;
        if (spared(sight.why_hidden(i, patch.shape), savings, draws.counts)) continue;
        const DrawnPatches::State& state = drawn.of(patch);
        const PatchStore::Level& level = patch.levels[state.level];
        const std::uint32_t fine = lit_at_vertices(level, state.rate);
        append(draws.fine, level.first_index, fine);
        append(draws.solid, level.first_index + fine, level.index_count - fine);
        ++draws.counts.drawn;
        draws.counts.coarser += state.level > 0 ? 1 : 0;
        draws.counts.vertex_rate += fine > 0 ? 1 : 0;
        draws.counts.triangles += level.index_count / 3;
    }
    return draws;
}

}  // namespace burin::renderer
