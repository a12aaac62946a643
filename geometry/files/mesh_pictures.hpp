// SPDX-License-Identifier: MIT
// The pictures that a mesh's file names (map_Kd of an OBJ's materials, TextureFile of a PLY), each read once, and the
// colours that its faces have by them. What cannot be read is a remark, and its faces keep their colour. A name with a
// path that leads nowhere here, as programs write those of another machine, is looked for beside the mesh as well.
// Internal to geometry/files/. Bounds: kMostMeshPictures. One thread.
#pragma once

#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/files/mesh_import.hpp"
#include "geometry/files/mesh_soup.hpp"
#include "geometry/files/picture.hpp"

namespace burin::geometry {

inline constexpr std::size_t kMostMeshPictures = 1000;

// A picture as a statement wears it. Coordinates are scaled, then moved; colours become base + gain times themselves.
struct PictureUse {
    std::vector<std::string> names;  // the file's, with / between folders: the statement may be read in several ways
    Vec2 scale{1.0}, offset{0.0};
    PictureWrap wrap;
    double base = 0.0, gain = 1.0;
    std::vector<std::string> ignored = {};  // options that change nothing here, and what could not be understood
};

// Reads what follows map_Kd (Wavefront MTL): options, of which -o, -s, -clamp and -mm count, and the name of a file.
[[nodiscard]] PictureUse picture_use(std::string_view statement);
// Returns the names that the rest of a line may mean: whole, without a comment behind it, without quotes around it.
[[nodiscard]] std::vector<std::string> names_in(std::string_view rest);

class MeshPictures {
public:
    explicit MeshPictures(const MaterialFileReader& read) : read_(read) {}

    // Null: it cannot be read.
    [[nodiscard]] const Picture* worn_by(const PictureUse& use);
    [[nodiscard]] const std::vector<std::string>& worn() const { return worn_; }  // those that were read
    [[nodiscard]] const std::vector<std::string>& remarks() const { return remarks_; }

private:
    [[nodiscard]] Result<Picture> opened(const std::vector<std::string>& names) const;

    const MaterialFileReader& read_;
    std::map<std::string, std::optional<Picture>> known_;
    std::vector<std::string> remarks_;
    std::vector<std::string> worn_;
};

inline constexpr std::uint32_t kNoPicture = std::numeric_limits<std::uint32_t>::max();

// Which picture each face wears, and where.
struct WornFaces {
    std::vector<PictureUse> uses;
    std::vector<std::uint32_t> use_of_face;  // into uses, or kNoPicture
    std::vector<Vec2> places;                // of each corner of the soup; not finite: it has none
};

// Gives the soup the colours of its corners. Vertex colours multiply with those of a picture, and so does the face's
// colour with a picture of greys; any other takes its place. Changes nothing where no picture can be read.
void wear_pictures(MeshSoup& soup, const WornFaces& faces, const MaterialFileReader& read);

}  // namespace burin::geometry
