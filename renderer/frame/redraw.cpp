// SPDX-License-Identifier: MIT
#include "renderer/frame/redraw.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "picture/contact_marks.hpp"
#include "wall/projection.hpp"

namespace burin::renderer {
namespace {

constexpr double kNearest_m = 0.02;  // nothing nearer than this to an eye's plane is projected

Box box_around(const picture::Ball& ball) {
    return {ball.center_world - Vec3(ball.radius_m), ball.center_world + Vec3(ball.radius_m)};
}

Vec3 corner_of(const Box& box, int corner) {
    return {(corner & 1) != 0 ? box.hi.x : box.lo.x, (corner & 2) != 0 ? box.hi.y : box.lo.y,
            (corner & 4) != 0 ? box.hi.z : box.lo.z};
}

Box world_box(const picture::Picture& picture, const Box& patch) {
    Box world;
    for (int i = 0; i < 8; ++i)
        world.include(picture.world_from_object * (picture.lattice_origin_object + corner_of(patch, i)));
    return world;
}

// Returns the bounds of the solid shapes, on which the tool's shadow may fall besides the workpiece. Room, glass and
// panel receive no shadow of the tool.
std::vector<Box> lit_things(const Shown& in) {
    const picture::Picture& picture = in.picture;
    std::vector<Box> things;
    for (const picture::PictureBox* box : {&picture.box, &picture.proposed_box})
        if (box->visible) things.push_back(box_around(picture::ball_of(*box)));
    for (const Box& mark : picture::boxes_of(picture::contact_marks(picture)))
        if (!mark.empty()) things.push_back(mark);
    for (const picture::DrawnObject& object : picture.objects) things.push_back(picture::bounds_world(object));
    if (picture.pedestal.visible) {
        const picture::PicturePedestal& p = picture.pedestal;
        const double height_m = std::max(p.top_center_world.y, 0.001);
        things.push_back({p.top_center_world - Vec3(p.radius_m, height_m, p.radius_m),
                          p.top_center_world + Vec3(p.radius_m, 0.0, p.radius_m)});
    }
    if (picture.show_wall_frame) {
        constexpr double kFrame_m = 0.06;  // the depth and width of the frame's bars
        const wall::Screen& s = picture.screen;
        const Vec3 upper_right = s.upper_left_world + (s.lower_right_world - s.lower_left_world);
        for (const auto& [a, b] :
             {std::pair(s.lower_left_world, s.lower_right_world), std::pair(s.lower_left_world, s.upper_left_world),
              std::pair(s.lower_right_world, upper_right), std::pair(s.upper_left_world, upper_right)})
            things.push_back({glm::min(a, b) - Vec3(kFrame_m), glm::max(a, b) + Vec3(kFrame_m)});
    }
    return things;
}

// Returns the shadow of one ball of the tool, from the ball on, in slices:
// one box around the whole shadow would hold much that is not in it.
std::array<Box, 12> shadow_of(const picture::Ball& ball, double tool_radius_m) {
    std::array<Box, 12> slices;
    const double length_m = double{shared::kToolShades} * tool_radius_m;
    const auto at = [&](double along_m, double radius_m) {
        return box_around({ball.center_world - along_m * picture::direction_to_light(), radius_m});
    };
    for (std::size_t i = 0; i < slices.size(); ++i) {
        const double from_m = length_m * static_cast<double>(i) / slices.size(),
                     to_m = length_m * static_cast<double>(i + 1) / slices.size();
        // The penumbra is as wide as the lamp appears from there, or a fiftieth of the ball (hidden_share in
        // shaders/lighting.glsl); twice the ball's radius accounts for what lies behind the ball's own middle.
        const double edge_m = picture::kLightHalfAngleTangent * (to_m + 2.0 * ball.radius_m) + 0.02 * tool_radius_m;
        const Box a = at(from_m, ball.radius_m + edge_m), b = at(to_m, ball.radius_m + edge_m);
        slices[i] = {glm::min(a.lo, b.lo), glm::max(a.hi, b.hi)};
    }
    return slices;
}

// Collects rectangles of objects at their positions in one scene.
class Parts {
public:
    Parts(const picture::Picture& picture, ImageSize size) : picture_(picture), size_(size) {}

    void add(const Box& box_world) { rects.push_back(seen_part(picture_, size_, std::span(&box_world, 1))); }
    void add(const picture::Ball& ball) {
        if (ball.radius_m > 0.0) add(box_around(ball));
    }
    // Adds all that the tool affects around it, except the workpiece.
    void add_tool(const Shown& in) {
        const picture::PictureTool& tool = in.picture.tool;
        if (!tool.visible) return;
        const std::vector<Box> lit = lit_things(in);
        Box darkened = box_around({tool.center_world, double{shared::kToolDarkens} * tool.radius_m});
        const Box other_end =
            box_around({tool.center_world + tool.spine_m, double{shared::kToolDarkens} * tool.radius_m});
        darkened.include(other_end.lo);
        darkened.include(other_end.hi);
        add_where(darkened, lit);
        add(picture::head_of(tool));
        for (const picture::Ball& ball : balls_of(tool)) {
            if (ball.radius_m <= 0.0) continue;
            add(ball);
            for (const Box& slice : shadow_of(ball, tool.radius_m)) add_where(slice, lit);
        }
    }
    void add(const picture::ContactMarks& marks) {
        for (const Box& box : picture::boxes_of(marks))
            if (!box.empty()) add(box);
    }
    void add(const std::optional<picture::PicturePanel>& panel) {
        if (!panel) return;
        std::array<Box, 4> corners;
        const std::array places = picture::corners_world(panel->stand);
        for (std::size_t i = 0; i < 4; ++i) corners[i].include(places[i]);
        rects.push_back(seen_part(picture_, size_, corners));
    }
    void add_patch(const Box& box) { add(world_box(picture_, box)); }

    std::vector<PixelRect> rects;

private:
    void add_where(const Box& box, std::span<const Box> things) {
        for (const Box& thing : things) {
            const Box common{glm::max(box.lo, thing.lo), glm::min(box.hi, thing.hi)};
            if (!common.empty()) add(common);
        }
    }

    const picture::Picture& picture_;
    ImageSize size_;
};

constexpr std::uint32_t kCell_px = 16;
// Cost of drawing one more rectangle, in pixels: it takes a pass
// of its own, and what crosses its edges is processed twice.
constexpr std::int64_t kPrice_px = 4096;
constexpr std::int64_t kMostOfAll = 80;  // percent of the picture's area beyond which all of it is redrawn

std::int64_t area(const PixelRect& r) { return std::int64_t{r.width} * r.height; }

// The picture as a grid of cells, each damaged or not; the last column and row may be narrower.
class Cells {
public:
    explicit Cells(ImageSize size)
        : size_(size),
          columns_((size.width + kCell_px - 1) / kCell_px),
          rows_((size.height + kCell_px - 1) / kCell_px),
          wanted_(std::size_t{columns_} * rows_) {}

    void add(const PixelRect& r) {
        if (r.empty()) return;
        for (std::uint32_t y = r.y / kCell_px; y <= (r.y + r.height - 1) / kCell_px; ++y)
            for (std::uint32_t x = r.x / kCell_px; x <= (r.x + r.width - 1) / kCell_px; ++x)
                wanted_[std::size_t{y} * columns_ + x] = true;
    }

    // Returns rectangles of damaged cells: runs within a row, merged with runs of the same extent in the rows below.
    [[nodiscard]] std::vector<PixelRect> runs() const {
        std::vector<PixelRect> made;
        for (std::uint32_t y = 0; y < rows_; ++y)
            for (std::uint32_t x = 0; x < columns_;) {
                std::uint32_t end = x;
                while (end < columns_ && wanted_[std::size_t{y} * columns_ + end]) ++end;
                if (end > x) add_run(made, pixels(x, y, end));
                x = std::max(end, x + 1);
            }
        return made;
    }

private:
    [[nodiscard]] PixelRect pixels(std::uint32_t from, std::uint32_t row, std::uint32_t end) const {
        const std::uint32_t x = from * kCell_px, y = row * kCell_px;
        return {x, y, std::min(end * kCell_px, size_.width) - x, std::min(y + kCell_px, size_.height) - y};
    }
    static void add_run(std::vector<PixelRect>& made, const PixelRect& run) {
        const auto above = std::ranges::find_if(
            made, [&](const PixelRect& r) { return r.x == run.x && r.width == run.width && r.y + r.height == run.y; });
        if (above != made.end()) {
            above->height += run.height;
        } else {
            made.push_back(run);
        }
    }

    ImageSize size_;
    std::uint32_t columns_ = 0, rows_ = 0;
    std::vector<bool> wanted_;
};

// Returns the two rectangles whose merging saves most, if any saves anything.
std::optional<std::pair<std::size_t, std::size_t>> best_pair(const std::vector<PixelRect>& parts) {
    std::optional<std::pair<std::size_t, std::size_t>> best;
    std::int64_t least = kPrice_px;
    for (std::size_t i = 0; i < parts.size(); ++i)
        for (std::size_t j = i + 1; j < parts.size(); ++j) {
            const std::int64_t more = area(around(parts[i], parts[j])) - area(parts[i]) - area(parts[j]);
            if (more >= least) continue;
            least = more;
            best = {i, j};
        }
    return best;
}

// Returns the smallest rectangle around the given rectangles' parts inside `part`.
PixelRect within(const PixelRect& part, std::span<const PixelRect> rects) {
    PixelRect wanted;
    for (const PixelRect& r : rects) wanted = around(wanted, common(part, r));
    return wanted;
}

}  // namespace

bool same_room(const Shown& a, const Shown& b) {
    return same_room(a.picture, b.picture) && a.workpiece == b.workpiece && a.depth == b.depth;
}

bool same_room(const picture::Picture& a, const picture::Picture& b) {
    picture::Picture s = a;
    s.tool = b.tool;
    s.contact = b.contact;
    s.box = b.box;
    s.proposed_box = b.proposed_box;
    s.bubble = b.bubble;
    s.panel = b.panel;
    return s == b;
}

PixelRect seen_part(const picture::Picture& picture, ImageSize size, std::span<const Box> boxes_world) {
    const wall::Screen& screen = picture.screen;
    const double width_m = glm::length(screen.lower_right_world - screen.lower_left_world);
    const double height_m = glm::length(screen.upper_left_world - screen.lower_left_world);
    const wall::Eyes eyes = wall::eyes_of(picture.viewer);
    const wall::ScreenPlane plane(screen);
    Vec2 lo(HUGE_VAL), hi(-HUGE_VAL);
    // With the fade a point is drawn between its positions as seen
    // by the eye and from the middle, which lies between the eyes.
    for (const Vec3& eye :
         {eyes.left_world, eyes.right_world, picture.edge_fade > 0.0 ? middle_of(eyes) : eyes.left_world}) {
        const double eye_m = plane.distance_in_front(eye);
        for (std::size_t i = 0; i < 8 * boxes_world.size(); ++i) {
            const Vec3 p = corner_of(boxes_world[i / 8], static_cast<int>(i % 8));
            if (eye_m - plane.distance_in_front(p) < kNearest_m) return all_of(size);
            const Vec2 at = plane.point_seen(eye, p);
            const Vec2 px{at.x / width_m * size.width, (1.0 - at.y / height_m) * size.height};
            lo = glm::min(lo, px);
            hi = glm::max(hi, px);
        }
    }
    // Two extra pixels for rounding, and for what touches a pixel without covering its middle.
    const auto clamped = [](double v, std::uint32_t most) {
        return static_cast<std::uint32_t>(std::clamp(v, 0.0, static_cast<double>(most)));
    };
    const std::uint32_t x0 = clamped(std::floor(lo.x) - 2.0, size.width),
                        x1 = clamped(std::ceil(hi.x) + 2.0, size.width);
    const std::uint32_t y0 = clamped(std::floor(lo.y) - 2.0, size.height),
                        y1 = clamped(std::ceil(hi.y) + 2.0, size.height);
    return {x0, y0, x1 - x0, y1 - y0};
}

std::vector<PixelRect> changed_rects(const Shown& shown, const Shown& wanted, ImageSize size,
                                     std::span<const Box> changed) {
    Parts parts(wanted.picture, size);
    const auto if_changed = [&](const auto& before, const auto& now, const auto& place) {
        if (before == now) return;
        parts.add(place(before));
        parts.add(place(now));
    };
    const auto itself = [](const auto& thing) { return thing; };
    const auto ball = [](const auto& thing) { return picture::ball_of(thing); };
    const picture::Picture &before = shown.picture, &now = wanted.picture;
    if (before.tool != now.tool) {
        parts.add_tool(shown);
        parts.add_tool(wanted);
    }
    if_changed(picture::contact_marks(before), picture::contact_marks(now), itself);
    if_changed(before.box, now.box, ball);
    if_changed(before.proposed_box, now.proposed_box, ball);
    if_changed(before.bubble, now.bubble, ball);
    if_changed(std::pair(before.panel, shown.panel_pictures), std::pair(now.panel, wanted.panel_pictures),
               [](const auto& panel) { return panel.first; });
    for (const Box& box : changed) parts.add_patch(box);
    return std::move(parts.rects);
}

std::vector<PixelRect> damage_rectangles(std::span<const PixelRect> rects, ImageSize size) {
    Cells cells(size);
    for (const PixelRect& r : rects) cells.add(r);
    std::vector<PixelRect> parts = cells.runs();
    while (const auto pair = best_pair(parts)) {
        parts[pair->first] = around(parts[pair->first], parts[pair->second]);
        parts.erase(parts.begin() + static_cast<std::ptrdiff_t>(pair->second));
    }
    for (PixelRect& part : parts) part = within(part, rects);  // cells at its edges may be damaged only in part
    std::int64_t sum = 0;
    for (const PixelRect& part : parts) sum += area(part);
    if (100 * sum > kMostOfAll * area(all_of(size))) return {all_of(size)};
    return parts;
}

}  // namespace burin::renderer
