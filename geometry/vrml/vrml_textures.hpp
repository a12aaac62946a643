// SPDX-License-Identifier: MIT
// Textures of VRML (ISO/IEC 14772-1:1997, 6.22 ImageTexture, 6.33 PixelTexture, 6.48 TextureTransform) as colours of
// corners: there is no texture in a session. Pictures are found as inlined files are: in the world's folder and below
// it, or below the root. Each is read once. What cannot be read is a remark, and the material's colour stands.
// A picture of greys alone darkens the colours that a shape has, another takes their place. Transparency in it has no
// effect. Internal to geometry/vrml/. Bounds: kMostVrmlPictures, kMostVrmlPicturePixels in all. Cost: linear.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "geometry/files/picture.hpp"
#include "geometry/vrml/vrml_fields.hpp"
#include "geometry/vrml/vrml_shapes.hpp"

namespace burin::geometry {

inline constexpr std::size_t kMostVrmlPictures = 1000;
inline constexpr std::uint64_t kMostVrmlPictureBytes = 1u << 30;  // of their files together

struct VrmlTexture {
    std::shared_ptr<const Picture> picture;  // null: none that can be shown
    PictureWrap wrap;
    // Tc' = -C * S * R * C * T * Tc
    Vec2 translation{0.0}, center{0.0}, scale{1.0};
    double rotation_rad = 0.0;

    [[nodiscard]] Vec2 transformed(const Vec2& at) const;
};

class VrmlTextures {
public:
    explicit VrmlTextures(VrmlFields& fields) : fields_(fields) {}

    // Reads the texture of an Appearance. A node that is none that can be shown is told to `skip`.
    template <typename Skip>
    [[nodiscard]] VrmlTexture texture_of(const VrmlPlaced& appearance, Skip&& skip) {
        VrmlTexture texture;
        for (const VrmlPlaced& given : fields_.nodes(appearance, "texture")) {
            const auto node = fields_.resolved(given);
            if (!node || !read(*node, texture)) skip(node.value_or(given));
        }
        for (const VrmlPlaced& given : fields_.nodes(appearance, "textureTransform")) {
            const auto node = fields_.resolved(given);
            if (!node || !read_transform(*node, texture)) skip(node.value_or(given));
        }
        return texture;
    }

private:
    // Return whether the node is of a type that is shown, whatever came of it.
    [[nodiscard]] bool read(const VrmlPlaced& node, VrmlTexture& texture);
    [[nodiscard]] bool read_transform(const VrmlPlaced& node, VrmlTexture& texture);
    [[nodiscard]] std::shared_ptr<const Picture> file_of(const VrmlPlaced& node);
    [[nodiscard]] std::shared_ptr<const Picture> pixels_of(const VrmlPlaced& node);
    [[nodiscard]] Result<std::shared_ptr<const Picture>> opened(std::string_view url, std::uint32_t in_file);

    VrmlFields& fields_;
    std::map<std::string, Result<std::shared_ptr<const Picture>>> known_;  // by name below the root
    std::map<std::uint32_t, std::shared_ptr<const Picture>> of_pixels_;    // by node
    std::uint64_t bytes_ = 0;
};

// Returns the surface with the picture's colours at its corners. `type` is that of its node, `own` the shape's colour.
[[nodiscard]] std::shared_ptr<const VrmlSurface> painted(const VrmlSurface& surface, std::string_view type,
                                                         const VrmlTexture& texture, const VrmlColour& own);

// Returns the names, below the root, of all pictures that a world may read, whether they are there or not.
[[nodiscard]] std::vector<std::string> vrml_picture_names(const VrmlFile& file);

}  // namespace burin::geometry
