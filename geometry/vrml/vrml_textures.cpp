// SPDX-License-Identifier: MIT
#include "geometry/vrml/vrml_textures.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <utility>

#include "base/try.hpp"
#include "geometry/files/text_scanner.hpp"
#include "geometry/vrml/vrml_inlines.hpp"

namespace burin::geometry {
namespace {

using TextureCorners = std::array<Vec2, 3>;

constexpr const char* kOwnColour = "the colour of its material stands in its place";

// ---- Where solids have a picture, by the standard

double turned(double x, double z) {  // from the back, counter-clockwise seen from above, 0 to 1
    const double turn = std::atan2(-x, -z) / (2.0 * std::numbers::pi);
    return turn < 0.0 ? turn + 1.0 : turn;
}

// Brings the corners to one side of the seam at the back, that of the middle. On the axis there is no turn.
void join_at_seam(TextureCorners& at, const std::array<Vec3, 3>& p) {
    const Vec3 middle = (p[0] + p[1] + p[2]) / 3.0;
    const double there = turned(middle.x, middle.z);
    for (std::size_t i = 0; i < 3; ++i) {
        if (p[i].x == 0.0 && p[i].z == 0.0) at[i].x = there;
        at[i].x -= std::round(at[i].x - there);
    }
}

TextureCorners on_box(const std::array<Vec3, 3>& p, const Vec3& normal, const Box& box) {
    const Vec3 size = glm::max(box.extent(), Vec3(1e-300)), side = glm::abs(normal);
    TextureCorners at{};
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 q = (p[i] - box.lo) / size;  // 0 to 1
        if (side.z >= side.x && side.z >= side.y)
            at[i] = {normal.z > 0.0 ? q.x : 1.0 - q.x, q.y};
        else if (side.x >= side.y)
            at[i] = {normal.x > 0.0 ? 1.0 - q.z : q.z, q.y};
        else
            at[i] = {q.x, normal.y > 0.0 ? 1.0 - q.z : q.z};
    }
    return at;
}

TextureCorners on_round(std::string_view type, const std::array<Vec3, 3>& p, const Vec3& normal, const Box& box) {
    const Vec3 size = glm::max(box.extent(), Vec3(1e-300));
    const bool is_cap = type != "Sphere" && normal.x == 0.0 && normal.z == 0.0;
    TextureCorners at{};
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 q = (p[i] - box.lo) / size;
        if (is_cap)
            at[i] = {q.x, normal.y > 0.0 ? 1.0 - q.z : q.z};
        else if (type == "Sphere")
            at[i] = {turned(p[i].x, p[i].z),
                     0.5 + std::asin(std::clamp(2.0 * q.y - 1.0, -1.0, 1.0)) / std::numbers::pi};
        else
            at[i] = {turned(p[i].x, p[i].z), q.y};
    }
    if (!is_cap) join_at_seam(at, p);
    return at;
}

}  // namespace

Vec2 VrmlTexture::transformed(const Vec2& at) const {
    const Vec2 moved = at + translation + center;
    const double c = std::cos(rotation_rad), s = std::sin(rotation_rad);
    return scale * Vec2(c * moved.x - s * moved.y, s * moved.x + c * moved.y) - center;
}

bool VrmlTextures::read(const VrmlPlaced& node, VrmlTexture& texture) {
    const std::string_view type = fields_.type(node);
    if (type != "ImageTexture" && type != "PixelTexture") return false;
    if (!fields_.spend(fields_.place(node), 1)) return true;
    fields_.check_names(node);
    texture.picture = type == "ImageTexture" ? file_of(node) : pixels_of(node);
    texture.wrap = {fields_.flag(node, "repeatS", true), fields_.flag(node, "repeatT", true)};
    return true;
}

bool VrmlTextures::read_transform(const VrmlPlaced& node, VrmlTexture& texture) {
    if (fields_.type(node) != "TextureTransform") return false;
    fields_.check_names(node);
    const auto two = [&](std::string_view name, const Vec2& otherwise) {
        const std::span<const double> numbers = fields_.numbers(node, name, 2, kAnyVrmlNumber).values;
        return numbers.size() == 2 ? Vec2(numbers[0], numbers[1]) : otherwise;
    };
    texture.translation = two("translation", Vec2(0.0));
    texture.center = two("center", Vec2(0.0));
    texture.scale = two("scale", Vec2(1.0));
    texture.rotation_rad = fields_.number(node, "rotation", 0.0);
    return true;
}

std::shared_ptr<const Picture> VrmlTextures::file_of(const VrmlPlaced& node) {
    const auto url = fields_.find(node, "url");
    if (!url || url->field->kind != VrmlKind::strings || url->field->count == 0) return nullptr;
    std::optional<Error> first;
    for (std::uint32_t i = 0; i < url->field->count; ++i) {
        const Result<std::shared_ptr<const Picture>> picture =
            opened(fields_.file().strings[url->field->first + i], url->file);
        if (picture) return *picture;
        if (!first) first = picture.error();
    }
    const std::string what = first->where.empty() ? first->what : first->where + " " + first->what;
    fields_.remark_at_value(*url, 0, what, first->remedy + "; " + kOwnColour);
    return nullptr;
}

Result<std::shared_ptr<const Picture>> VrmlTextures::opened(std::string_view url, std::uint32_t in_file) {
    const VrmlFile& file = fields_.file();
    const std::filesystem::path folder = std::filesystem::path(file.sources[in_file].below).parent_path();
    BURIN_TRY(name, named_vrml_file("a texture", url, folder));
    if (const auto known = known_.find(name); known != known_.end()) return known->second;
    const auto read_it = [&]() -> Result<std::shared_ptr<const Picture>> {
        if (!file.opener) return fail(name, "cannot be opened: there is no folder", "save the world as a file");
        if (known_.size() >= kMostVrmlPictures || bytes_ > kMostVrmlPictureBytes)
            return fail(name, "is one picture too many", "a world shows 1000 pictures, 1 GiB together");
        BURIN_TRY(bytes, file.opener(name));
        bytes_ += bytes.size();
        BURIN_TRY(picture, Picture::decode(std::as_bytes(std::span(bytes)), name));
        return std::make_shared<const Picture>(std::move(picture));
    };
    return known_.emplace(name, read_it()).first->second;
}

// The image is a width, a height, a number of components, and a number for each pixel, from the lower left on.
std::shared_ptr<const Picture> VrmlTextures::pixels_of(const VrmlPlaced& node) {
    if (const auto known = of_pixels_.find(node.node); known != of_pixels_.end() && !fields_.node(node).bound)
        return known->second;
    std::shared_ptr<const Picture>& made = of_pixels_[node.node];
    made = nullptr;
    const VrmlNumbers image = fields_.numbers(node, "image", 1, kAnyVrmlNumber);
    const std::span<const double> numbers = image.values;
    if (numbers.size() < 3 || numbers[0] == 0.0 || numbers[1] == 0.0 || numbers[2] == 0.0) return nullptr;
    // Four components fill 32 bits, which some programs write with a sign.
    const auto is_pixel = [](double n) { return n == std::floor(n) && n >= -2147483648.0 && n <= 4294967295.0; };
    const bool is_sound = numbers[0] >= 1.0 && numbers[1] >= 1.0 && numbers[2] >= 1.0 && numbers[2] <= 4.0 &&
                          numbers[0] * numbers[1] + 3.0 == static_cast<double>(numbers.size()) &&
                          std::ranges::all_of(numbers, is_pixel);
    if (!is_sound) {
        fields_.remark_at_value(image.value, 0, "a PixelTexture has no sound image",
                                std::string("give its width, height, components and pixels; ") + kOwnColour);
        return nullptr;
    }
    const auto width = static_cast<std::uint32_t>(numbers[0]), height = static_cast<std::uint32_t>(numbers[1]);
    const auto components = static_cast<unsigned>(numbers[2]);
    std::vector<std::uint8_t> rgb(std::size_t{3} * width * height);
    for (std::size_t i = 0; i < std::size_t{width} * height; ++i) {
        const auto packed = static_cast<std::uint32_t>(static_cast<std::int64_t>(numbers[3 + i]));
        const std::size_t row = height - 1 - i / width, to = 3 * (row * width + i % width);
        for (unsigned c = 0; c < 3; ++c) {
            // 1 grey, 2 grey and alpha, 3 colours, 4 colours and alpha; the first in the highest byte.
            const unsigned byte = components <= 2 ? components - 1 : components - 1 - c;
            rgb[to + c] = static_cast<std::uint8_t>(packed >> (8 * byte));
        }
    }
    return made = std::make_shared<const Picture>(width, height, std::move(rgb), components <= 2);
}

std::shared_ptr<const VrmlSurface> painted(const VrmlSurface& surface, std::string_view type,
                                           const VrmlTexture& texture, const VrmlColour& own) {
    auto made = std::make_shared<VrmlSurface>(surface);
    made->corner_texture.clear();
    made->corner_texture.shrink_to_fit();
    const TriangleMesh& mesh = surface.mesh;
    Box box;
    for (const Vec3& p : mesh.positions_m) box.include(p);
    std::vector<std::array<VrmlColour, 3>> colours;
    colours.reserve(mesh.triangles.size());
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const auto& t = mesh.triangles[i];
        const std::array<Vec3, 3> p{mesh.positions_m[t[0]], mesh.positions_m[t[1]], mesh.positions_m[t[2]]};
        const Vec3 normal = glm::cross(p[1] - p[0], p[2] - p[0]);
        std::array<VrmlColour, 3> worn{texture.picture->mean(), texture.picture->mean(), texture.picture->mean()};
        if (!surface.corner_texture.empty() || type != "Extrusion") {
            TextureCorners at = !surface.corner_texture.empty() ? surface.corner_texture[i]
                                : type == "Box"                 ? on_box(p, normal, box)
                                                                : on_round(type, p, normal, box);
            for (Vec2& corner : at) corner = texture.transformed(corner);
            std::ranges::copy(texture.picture->colours_of(at, texture.wrap), worn.begin());
        }
        if (texture.picture->is_grey())
            for (std::size_t c = 0; c < 3; ++c)
                worn[c] = darkened(surface.corner_colours.empty() ? own : surface.corner_colours[i][c], worn[c]);
        colours.push_back(worn);
    }
    made->corner_colours = std::move(colours);
    return made;
}

std::vector<std::string> vrml_picture_names(const VrmlFile& file) {
    std::vector<std::string> names;
    const auto note = [&](std::uint32_t in_file, std::span<const VrmlField> fields) {
        const std::filesystem::path folder = std::filesystem::path(file.sources[in_file].below).parent_path();
        for (const VrmlField& field : fields) {
            if (field.kind != VrmlKind::strings) continue;
            for (const std::string_view url : std::span(file.strings).subspan(field.first, field.count))
                if (const Result<std::string> name = named_vrml_file("a texture", url, folder)) names.push_back(*name);
        }
    };
    // An instance of a PROTO may give the name, whatever its field is called.
    for (const VrmlNode& node : file.nodes)
        if (node.prototype != kNoVrmlIndex || file.type_of(node) == "ImageTexture")
            note(node.file, file.fields_of(node));
    for (const VrmlPrototype& prototype : file.prototypes) note(prototype.file, file.fields_of(prototype));
    return names;
}

}  // namespace burin::geometry
