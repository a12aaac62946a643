// SPDX-License-Identifier: MIT
// IndexedFaceSet and ElevationGrid (ISO/IEC 14772-1:1997, 6.23 and 6.17).
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "geometry/files/mesh_import.hpp"
#include "geometry/mesh/polygon.hpp"
#include "geometry/vrml/vrml_geometry.hpp"

namespace burin::geometry {
namespace {

constexpr std::size_t kShownOfAList = 8;  // wrong indices of one list that are named one by one

// Reads a list of indices below `count`, with -1 at the end of each face. Returns nothing where one is wrong.
std::vector<std::int32_t> read_indices(VrmlFields& fields, const VrmlNumbers& numbers, std::size_t count,
                                       const char* what) {
    std::vector<std::int32_t> indices;
    indices.reserve(numbers.values.size());
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < numbers.values.size(); ++i) {
        const double index = numbers.values[i];
        if (index == std::floor(index) && index >= -1.0 && index < static_cast<double>(count)) {
            indices.push_back(static_cast<std::int32_t>(index));
        } else if (++wrong <= kShownOfAList) {
            const std::string number =
                index == std::floor(index) ? std::to_string(static_cast<std::int64_t>(index)) : std::to_string(index);
            fields.fault_at_value(numbers.value, i,
                                  "index " + number + " names none of the " + std::to_string(count) + " " + what,
                                  "write whole numbers from 0 on, and -1 behind each face");
        }
    }
    if (wrong > kShownOfAList) {
        fields.fault({numbers.value.file, numbers.value.field->value_at},
                     std::to_string(wrong) + " indices of this list are wrong", "export the file again");
    }
    if (wrong > 0) indices.clear();
    return indices;
}

// The colours of a face set: one for each face or each corner, by an index or by their order.
class FaceColours {
public:
    FaceColours(const VrmlGeometryRequest& request, const std::vector<std::int32_t>& corners)
        : request_(request), corners_(corners), colours_(vrml_colours(request)) {
        VrmlFields& fields = request.fields;
        if (colours_.empty()) return;
        per_vertex_ = fields.flag(request.node, "colorPerVertex", true);
        numbers_ = fields.numbers(request.node, "colorIndex");
        indices_ = read_indices(fields, numbers_, colours_.size(), "colours");
        if (indices_.empty() && !numbers_.values.empty()) colours_.clear();  // wrong ones
    }

    [[nodiscard]] bool any() const { return !colours_.empty(); }

    // Returns the colour of the corner `at` of the list of corners, which belongs to the face number `face`.
    VrmlColour of(std::size_t at, std::size_t face) {
        std::size_t index = per_vertex_ ? at : face;
        if (!numbers_.values.empty()) {
            const std::int32_t named = index < indices_.size() ? indices_[index] : -1;
            if (named < 0) return missing(index);
            index = static_cast<std::size_t>(named);
        } else if (per_vertex_) {
            index = static_cast<std::size_t>(corners_[at]);
        }
        return index < colours_.size() ? colours_[index] : missing(index);
    }

private:
    VrmlColour missing(std::size_t index) {
        if (!std::exchange(told_, true)) {
            request_.fields.fault(request_.fields.place(request_.node),
                                  std::string("there is no colour for ") + (per_vertex_ ? "corner " : "face ") +
                                      std::to_string(index) + " of this node",
                                  "give as many colours as it has, or look at colorPerVertex");
        }
        return {};
    }

    const VrmlGeometryRequest& request_;
    const std::vector<std::int32_t>& corners_;
    std::vector<VrmlColour> colours_;
    VrmlNumbers numbers_;
    std::vector<std::int32_t> indices_;
    bool per_vertex_ = true, told_ = false;
};

// Where the corners of a face set lie in its picture: by an index, by their order, or by the set's box, whose longest
// side is 1 wide in the picture, the second longest upwards in it.
class FaceTexture {
public:
    FaceTexture(const VrmlGeometryRequest& request, const std::vector<std::int32_t>& corners,
                std::span<const Vec3> points)
        : corners_(corners), points_(points) {
        if (!request.textured) return;
        VrmlFields& fields = request.fields;
        for (const VrmlPlaced& given : fields.nodes(request.node, "texCoord")) {
            const auto node = fields.resolved(given);
            if (!node || fields.type(*node) != "TextureCoordinate") continue;
            fields.check_names(*node);
            const std::span<const double> numbers = fields.numbers(*node, "point", 2, kAnyVrmlNumber).values;
            for (std::size_t i = 0; i < numbers.size(); i += 2) places_.emplace_back(numbers[i], numbers[i + 1]);
        }
        const std::span<const double> indices = fields.numbers(request.node, "texCoordIndex").values;
        indices_.assign(indices.begin(), indices.end());
        any_ = true;
        if (places_.empty()) spread_over_box();
    }

    [[nodiscard]] bool any() const { return any_; }

    // Has a grid without coordinates of its own cover its picture once.
    void spread_over_grid(std::uint32_t nx, std::uint32_t nz) {
        if (!any_ || !places_.empty()) return;
        for (std::uint32_t z = 0; z < nz; ++z)
            for (std::uint32_t x = 0; x < nx; ++x)
                places_.emplace_back(static_cast<double>(x) / (nx - 1), static_cast<double>(z) / (nz - 1));
    }

    // Returns the place of the corner `at` of the list of corners; the origin where the file gives none.
    [[nodiscard]] Vec2 of(std::size_t at) const {
        const double index = at < indices_.size() ? indices_[at] : static_cast<double>(corners_[at]);
        if (places_.empty()) return on_box(points_[static_cast<std::size_t>(corners_[at])]);
        return index >= 0.0 && index < static_cast<double>(places_.size()) ? places_[static_cast<std::size_t>(index)]
                                                                           : Vec2(0.0);
    }

private:
    void spread_over_box() {
        for (const std::int32_t corner : corners_)
            if (corner >= 0) box_.include(points_[static_cast<std::size_t>(corner)]);
        const Vec3 size = box_.empty() ? Vec3(1.0) : box_.extent();
        across_ = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        upwards_ = across_ == 0 ? 1 : 0;
        for (int k = 0; k < 3; ++k)
            if (k != across_ && size[k] > size[upwards_]) upwards_ = k;
        longest_ = size[across_] > 0.0 ? size[across_] : 1.0;
    }
    [[nodiscard]] Vec2 on_box(const Vec3& p) const {
        return Vec2(p[across_] - box_.lo[across_], p[upwards_] - box_.lo[upwards_]) / longest_;
    }

    const std::vector<std::int32_t>& corners_;
    std::span<const Vec3> points_;
    std::vector<Vec2> places_;
    std::vector<double> indices_;
    Box box_;
    double longest_ = 1.0;
    int across_ = 0, upwards_ = 1;
    bool any_ = false;
};

// Splits the faces of a list of corners, each ended by -1 or the list's end.
class FaceSplitter {
public:
    FaceSplitter(VrmlSurface& surface, const std::vector<std::int32_t>& corners, FaceColours& colours,
                 const FaceTexture& texture)
        : surface_(surface), corners_(corners), colours_(colours), texture_(texture) {}

    // Returns the number of faces of fewer than three corners.
    std::size_t split_all() {
        for (std::size_t i = 0; i <= corners_.size(); ++i) {
            if (i < corners_.size() && corners_[i] >= 0) continue;
            if (i > first_) split(i);
            first_ = i + 1;
        }
        return without_area_;
    }

private:
    void split(std::size_t end) {
        const std::size_t count = end - first_;
        if (count < 3) {
            ++without_area_;
        } else if (count == 3) {
            add({0, 1, 2});
        } else {
            polygon_.clear();
            for (std::size_t i = first_; i < end; ++i) polygon_.push_back(surface_.mesh.positions_m[vertex(i)]);
            for (const auto& triangle : split_polygon(polygon_).triangles) add(triangle);
        }
        ++face_;
    }

    [[nodiscard]] std::uint32_t vertex(std::size_t at) const { return static_cast<std::uint32_t>(corners_[at]); }

    void add(const std::array<std::uint32_t, 3>& triangle) {
        const std::array<std::size_t, 3> at{first_ + triangle[0], first_ + triangle[1], first_ + triangle[2]};
        surface_.mesh.triangles.push_back({vertex(at[0]), vertex(at[1]), vertex(at[2])});
        if (texture_.any())
            surface_.corner_texture.push_back({texture_.of(at[0]), texture_.of(at[1]), texture_.of(at[2])});
        if (!colours_.any()) return;
        surface_.corner_colours.push_back(
            {colours_.of(at[0], face_), colours_.of(at[1], face_), colours_.of(at[2], face_)});
    }

    VrmlSurface& surface_;
    const std::vector<std::int32_t>& corners_;
    FaceColours& colours_;
    const FaceTexture& texture_;
    std::vector<Vec3> polygon_;
    std::size_t first_ = 0, face_ = 0, without_area_ = 0;
};

// The points of a face set, with those of their numbers that no mesh can have.
struct FacePoints {
    std::vector<Vec3> points;
    VrmlNumbers numbers;
};

FacePoints points_of(const VrmlGeometryRequest& request) {
    VrmlFields& fields = request.fields;
    FacePoints found;
    for (const VrmlPlaced& given : fields.nodes(request.node, "coord")) {
        const auto node = fields.resolved(given);
        if (!node || fields.type(*node) != "Coordinate") {
            fields.fault(fields.place(given), "a Coordinate is expected here", "write coord Coordinate { point [ ] }");
            continue;
        }
        fields.check_names(*node);
        found.numbers = fields.numbers(*node, "point", 3, kAnyVrmlNumber);
        const std::span<const double> numbers = found.numbers.values;
        found.points.reserve(numbers.size() / 3);
        for (std::size_t i = 0; i < numbers.size(); i += 3)
            found.points.emplace_back(numbers[i], numbers[i + 1], numbers[i + 2]);
    }
    return found;
}

// Says which points no mesh can have: a fault where a face names one, else a remark. Puts these to a sound one, so that
// they count for nothing.
void check_points(VrmlFields& fields, FacePoints& found, const std::vector<std::int32_t>& corners) {
    const auto is_sound = [](const Vec3& p) {
        return glm::all(glm::lessThanEqual(glm::abs(p), Vec3(kMaxCoordinate)));  // false for nan
    };
    if (std::ranges::all_of(found.points, is_sound)) return;
    std::vector<bool> named(found.points.size());
    for (const std::int32_t corner : corners)
        if (corner >= 0) named[static_cast<std::size_t>(corner)] = true;
    const auto sound = std::ranges::find_if(found.points, is_sound);
    const Vec3 instead = sound == found.points.end() ? Vec3(0.0) : *sound;
    const std::span<const double> numbers = found.numbers.values;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const std::size_t point = i / 3;
        if (std::abs(numbers[i]) <= kMaxCoordinate || point >= found.points.size()) continue;
        const char* const what =
            std::isfinite(numbers[i]) ? "'point' has a number above 1e9" : "'point' has what is not a finite number";
        // Another face set may have remarked on the same point, which it does not name.
        const VrmlValue& value = found.numbers.value;
        if (named[point] && !fields.full())
            fields.fault(fields.file().place_of_value(value.file, *value.field, i), what,
                         "repair the file or export it again");
        else if (!named[point])
            fields.remark_at_value(value, i, what, "no face names the point, and it is left out");
        found.points[point] = instead;
    }
}

// Returns a dimension of a grid, or 0 with a fault.
double dimension(const VrmlGeometryRequest& request, const char* name) {
    const std::int64_t value = request.fields.integer(request.node, name, 0);
    if (value >= 0) return static_cast<double>(value);
    request.fields.fault_at_value(*request.fields.find(request.node, name), 0, std::string("'") + name + "' is below 0",
                                  "write the number of heights");
    return 0.0;
}

}  // namespace

VrmlSurface vrml_face_set(const VrmlGeometryRequest& request) {
    VrmlSurface surface;
    VrmlFields& fields = request.fields;
    FacePoints points = points_of(request);
    const VrmlNumbers numbers = fields.numbers(request.node, "coordIndex");
    if (!may_make(request, static_cast<double>(numbers.values.size()) - 2.0)) return {};
    const std::vector<std::int32_t> corners = read_indices(fields, numbers, points.points.size(), "points");
    check_points(fields, points, corners);
    surface.mesh.positions_m = std::move(points.points);
    FaceColours colours(request, corners);
    const FaceTexture texture(request, corners, surface.mesh.positions_m);
    const std::size_t without_area = FaceSplitter(surface, corners, colours, texture).split_all();
    if (without_area > 0) {
        fields.remark(fields.place(request.node), std::to_string(without_area) + " faces have fewer than three corners",
                      "they are left out");
    }
    apply_vrml_sides(request, surface);
    return surface;
}

VrmlSurface vrml_elevation_grid(const VrmlGeometryRequest& request) {
    VrmlSurface surface;
    VrmlFields& fields = request.fields;
    const double columns = dimension(request, "xDimension"), rows = dimension(request, "zDimension");
    const double dx = fields.positive(request.node, "xSpacing", 1.0);
    const double dz = fields.positive(request.node, "zSpacing", 1.0);
    const VrmlNumbers heights = fields.numbers(request.node, "height");
    if (columns * rows != static_cast<double>(heights.values.size())) {
        fields.fault(heights.value.field == nullptr ? fields.place(request.node)
                                                    : VrmlPlace{heights.value.file, heights.value.field->value_at},
                     "an ElevationGrid of " + std::to_string(static_cast<std::int64_t>(columns)) + " by " +
                         std::to_string(static_cast<std::int64_t>(rows)) + " has " +
                         std::to_string(heights.values.size()) + " heights",
                     "give xDimension times zDimension of them");
        return {};
    }
    if (dx == 0.0 || dz == 0.0) return {};
    if (columns < 2.0 || rows < 2.0 || !may_make(request, 2.0 * (columns - 1.0) * (rows - 1.0))) return {};
    const auto nx = static_cast<std::uint32_t>(columns), nz = static_cast<std::uint32_t>(rows);
    std::vector<std::int32_t> corners;  // the quads' corners in VRML's own form, so that colours are found in one way
    corners.reserve(heights.values.size() * 5);
    for (std::uint32_t z = 0; z < nz; ++z) {
        for (std::uint32_t x = 0; x < nx; ++x) {
            surface.mesh.positions_m.emplace_back(dx * x, heights.values[x + std::size_t{z} * nx], dz * z);
            if (x + 1 == nx || z + 1 == nz) continue;
            const auto corner = static_cast<std::int32_t>(x + z * nx), below = static_cast<std::int32_t>(nx);
            // Counter-clockwise seen from +Y.
            corners.insert(corners.end(), {corner, corner + below, corner + below + 1, corner + 1, -1});
        }
    }
    FaceColours colours(request, corners);
    FaceTexture texture(request, corners, surface.mesh.positions_m);
    texture.spread_over_grid(nx, nz);
    static_cast<void>(FaceSplitter(surface, corners, colours, texture).split_all());
    apply_vrml_sides(request, surface);
    return surface;
}

}  // namespace burin::geometry
