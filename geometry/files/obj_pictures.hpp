// SPDX-License-Identifier: MIT
// The pictures that the materials of an OBJ name (map_Kd), each read once. What cannot be read is a remark, and its
// material keeps its colour. A name with a path that leads nowhere here, as programs write those of another machine, is
// looked for beside the mesh as well. Internal to geometry/files/. Bounds: kMostObjPictures. One thread.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/files/mesh_import.hpp"
#include "geometry/files/picture.hpp"
#include "geometry/files/surface_colours.hpp"

namespace burin::geometry {

inline constexpr std::size_t kMostObjPictures = 1000;

// Returns the file that a map_Kd statement names behind its options, with / between folders.
[[nodiscard]] std::string picture_named(std::string_view statement);

class ObjPictures {
public:
    explicit ObjPictures(const MaterialFileReader& read) : read_(read) {}

    // Null: it cannot be read.
    [[nodiscard]] const Picture* named(const std::string& name);
    [[nodiscard]] std::size_t worn() const { return worn_; }  // pictures that were read
    [[nodiscard]] const std::vector<std::string>& remarks() const { return remarks_; }

private:
    [[nodiscard]] Result<Picture> opened(const std::string& name) const;

    const MaterialFileReader& read_;
    std::map<std::string, std::optional<Picture>> known_;
    std::vector<std::string> remarks_;
    std::size_t worn_ = 0;
};

// Returns the colours of a face's corners, of what has the colour `own` without the picture.
[[nodiscard]] std::vector<Colour> worn_colours(const Picture& picture, std::span<const Vec2> places, const Colour& own);

}  // namespace burin::geometry
