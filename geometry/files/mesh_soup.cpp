// SPDX-License-Identifier: MIT
#include "geometry/files/mesh_soup.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "base/try.hpp"
#include "geometry/mesh/mesh_placing.hpp"
#include "geometry/mesh/polygon.hpp"

namespace burin::geometry {
namespace {

std::uint32_t packed(const Colour& c) {
    return static_cast<std::uint32_t>(c[0]) << 16 | static_cast<std::uint32_t>(c[1]) << 8 | c[2];
}

int largest_difference(const Colour& a, const Colour& b) {
    int most = 0;
    for (std::size_t i = 0; i < 3; ++i) most = std::max(most, std::abs(int{a[i]} - int{b[i]}));
    return most;
}

// Returns the mean of three colours.
Colour mean_of_three(const Colour& a, const Colour& b, const Colour& c) {
    Colour mean{};
    for (std::size_t k = 0; k < 3; ++k)
        mean[k] = static_cast<std::uint8_t>((unsigned{a[k]} + unsigned{b[k]} + unsigned{c[k]} + 1) / 3);
    return mean;
}

// Derives face materials from vertex colours: a face takes the colour that two of its first three corners share, so
// that no colour arises at a border that the file does not have; of three different ones their mean, as of a picture.
void materials_from_vertices(MeshSoup& soup) {
    ColourMaterials materials(soup.materials);
    soup.face_materials.reserve(soup.corner_counts.size());
    std::size_t first = 0;
    for (const std::uint32_t count : soup.corner_counts) {
        Colour colour = kPlainColour;
        const auto corner = [&](std::size_t i) { return soup.colours[soup.corners[first + i]]; };
        if (count > 0) colour = corner(0);
        if (count > 2 && corner(0) != corner(1) && corner(0) != corner(2))
            colour = corner(1) == corner(2) ? corner(1) : mean_of_three(corner(0), corner(1), corner(2));
        soup.face_materials.push_back(materials.index_of(colour));
        first += count;
    }
}

// Vertices of one colour beside faces of their own say nothing where that colour is white, as programs write it that
// have none, or where the faces differ. Else the colours of vertices count, as docs/formats.md has it.
void choose_colours(MeshSoup& soup) {
    if (soup.colours.empty() || soup.face_materials.empty() || !soup.corner_colours.empty()) return;
    const auto colour_of = [&](std::uint32_t material) { return soup.materials[material].colour; };
    const bool faces_differ = std::ranges::adjacent_find(soup.face_materials, std::ranges::not_equal_to{}, colour_of) !=
                              soup.face_materials.end();
    const bool vertices_differ =
        std::ranges::adjacent_find(soup.colours, std::ranges::not_equal_to{}) != soup.colours.end();
    const bool is_white = soup.colours.front() == Colour{255, 255, 255};
    if (!vertices_differ && (faces_differ || is_white)) {
        if (!is_white)
            soup.report.remarks.emplace_back("its vertices have one colour, which does not hide those of its faces");
        soup.colours.clear();
        return;
    }
    const Colour faces = colour_of(soup.face_materials.front());
    if (faces_differ || (faces != Colour{255, 255, 255} && faces != soup.colours.front()))
        soup.report.remarks.emplace_back("its vertices have colours, which hide those of its faces");
    soup.face_materials.clear();
    soup.materials.clear();
}

// Colours of faces that the palette cannot hold stay those of their corners.
void keep_colours_beyond_palette(MeshSoup& soup) {
    if (soup.materials.size() <= kMaxMaterials || !soup.colours.empty() || !soup.corner_colours.empty()) return;
    soup.corner_colours.reserve(soup.corners.size());
    for (std::size_t face = 0; face < soup.corner_counts.size(); ++face)
        soup.corner_colours.insert(soup.corner_colours.end(), soup.corner_counts[face],
                                   soup.materials[soup.face_materials[face]].colour);
}

// Groups colours by their leading bits, as many bits as leave at most kMaxMaterials groups. A group's colour is the
// mean over its faces, its name that of its first material.
void reduce_palette(MeshSoup& soup) {
    if (soup.materials.size() <= kMaxMaterials) return;
    std::vector<std::uint64_t> uses(soup.materials.size());
    for (const std::uint32_t m : soup.face_materials) ++uses[m];
    std::vector<std::uint32_t> group_of(soup.materials.size());
    std::size_t groups = 0;
    for (unsigned dropped_bits = 0; dropped_bits <= 6; ++dropped_bits) {  // 2 bits a channel: at most 64 groups
        std::unordered_map<std::uint32_t, std::uint32_t> known;
        for (std::size_t m = 0; m < soup.materials.size(); ++m) {
            Colour c = soup.materials[m].colour;
            for (auto& channel : c) channel = static_cast<std::uint8_t>(channel >> dropped_bits);
            group_of[m] = known.try_emplace(packed(c), static_cast<std::uint32_t>(known.size())).first->second;
        }
        groups = known.size();
        if (groups <= kMaxMaterials) break;
    }
    std::vector<Material> merged(groups);
    std::vector<std::array<std::uint64_t, 4>> sums(groups);
    for (std::size_t m = 0; m < soup.materials.size(); ++m) {
        auto& sum = sums[group_of[m]];
        const std::uint64_t weight = std::max<std::uint64_t>(uses[m], 1);
        for (std::size_t i = 0; i < 3; ++i) sum[i] += weight * soup.materials[m].colour[i];
        if (sum[3] == 0) merged[group_of[m]].name = soup.materials[m].name;
        sum[3] += weight;
    }
    int worst = 0;
    for (std::size_t g = 0; g < groups; ++g) {
        for (std::size_t i = 0; i < 3; ++i) {
            merged[g].colour[i] = static_cast<std::uint8_t>((sums[g][i] + sums[g][3] / 2) / sums[g][3]);
        }
    }
    for (std::size_t m = 0; m < soup.materials.size(); ++m) {
        worst = std::max(worst, largest_difference(soup.materials[m].colour, merged[group_of[m]].colour));
    }
    for (auto& m : soup.face_materials) m = group_of[m];
    soup.report.materials_merged = soup.materials.size() - groups;
    soup.report.remarks.push_back("its " + std::to_string(soup.materials.size()) + " materials become " +
                                  std::to_string(groups) + " in a solid, which has room for " +
                                  std::to_string(kMaxMaterials) + "; a colour changes by up to " +
                                  std::to_string(worst) + " of 255");
    soup.materials = std::move(merged);
}

// Decides what becomes of vertices far from the origin: faulty are all of them in a mesh that stays where it lies, and
// those that no face names in one that is brought to its middle.
void judge_distant(MeshSoup& soup, const std::string& name, MeshOrigin origin) {
    if (soup.distant.empty()) return;
    std::vector<bool> is_named(soup.positions.size(), false);
    for (const std::uint32_t corner : soup.corners) is_named[corner] = true;
    for (const FaultyVertex& vertex : soup.distant) {
        if (origin == MeshOrigin::of_file || !is_named[vertex.vertex])
            soup.faulty.push_back(vertex);
        else if (soup.far.empty())
            soup.far = soup.has_bytes ? at_byte(name, vertex.place) : at_line(name, vertex.place);
    }
    std::ranges::sort(soup.faulty, {}, &FaultyVertex::vertex);
}

Result<void> leave_out_faulty(MeshSoup& soup, const std::string& name) {
    if (soup.faulty.empty()) return {};
    constexpr std::uint32_t kLeftOut = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> number(soup.positions.size(), 0);
    for (const FaultyVertex& faulty : soup.faulty) number[faulty.vertex] = kLeftOut;
    const auto where = [&](std::uint64_t at) { return soup.has_bytes ? at_byte(name, at) : at_line(name, at); };
    for (const std::uint32_t corner : soup.corners) {
        if (number[corner] != kLeftOut) continue;
        const auto named = std::ranges::find(soup.faulty, corner, &FaultyVertex::vertex);
        return fail(where(named->place), named->fault, named->remedy);
    }
    std::uint32_t kept = 0;
    for (std::size_t v = 0; v < number.size(); ++v) {
        if (number[v] == kLeftOut) continue;
        soup.positions[kept] = soup.positions[v];
        if (!soup.colours.empty()) soup.colours[kept] = soup.colours[v];
        number[v] = kept++;
    }
    soup.positions.resize(kept);
    if (!soup.colours.empty()) soup.colours.resize(kept);
    for (std::uint32_t& corner : soup.corners) corner = number[corner];
    const FaultyVertex& first = soup.faulty.front();
    soup.report.remarks.push_back(
        std::to_string(soup.faulty.size()) + " vertices that no face names were left out, the first in " +
        (soup.has_bytes ? "byte " : "line ") + std::to_string(first.place) + ": " + first.fault);
    return {};
}

// The numbers of the first faces of a kind in the file, from 1.
struct FirstFaces {
    std::size_t touching = 0, crossing = 0;
};

void count_polygon(ImportReport& report, PolygonSplit how, std::size_t face, FirstFaces& first) {
    ++report.polygons_in_file;
    switch (how) {
        case PolygonSplit::fan: ++report.polygons_fanned; break;
        case PolygonSplit::sweep: ++report.polygons_swept; break;
        case PolygonSplit::touching:
            if (report.polygons_touching++ == 0) first.touching = face + 1;
            break;
        case PolygonSplit::crossing:
            if (report.polygons_crossing++ == 0) first.crossing = face + 1;
            break;
    }
}

void remark_polygons(ImportReport& report, const FirstFaces& first) {
    if (report.polygons_touching > 0) {
        report.remarks.push_back(std::to_string(report.polygons_touching) +
                                 " polygons touch themselves, the first is face " + std::to_string(first.touching) +
                                 "; they were split without overlaps");
    }
    if (report.polygons_crossing > 0) {
        report.remarks.push_back(std::to_string(report.polygons_crossing) +
                                 " polygons cross themselves or have no area, the first is face " +
                                 std::to_string(first.crossing) + "; their triangles may overlap");
    }
}

FirstFaces split_faces(const MeshSoup& soup, ImportedMesh& imported) {
    TriangleMesh& mesh = imported.mesh;
    ImportReport& report = imported.report;
    mesh.triangles.reserve(soup.corner_counts.size());
    FirstFaces first_faces;
    std::vector<Vec3> polygon;
    std::size_t first = 0;
    for (std::size_t face = 0; face < soup.corner_counts.size(); ++face) {
        const std::uint32_t count = soup.corner_counts[face];
        const std::uint32_t* corner = soup.corners.data() + first;
        const auto add = [&, of_face = first](const std::array<std::uint32_t, 3>& t) {
            mesh.triangles.push_back({corner[t[0]], corner[t[1]], corner[t[2]]});
            if (soup.corner_colours.empty()) return;
            const auto* const colours = soup.corner_colours.data() + of_face;
            imported.corner_colours.push_back({colours[t[0]], colours[t[1]], colours[t[2]]});
        };
        first += count;
        if (count < 3) {
            ++report.faces_without_area;
            continue;
        }
        if (count == 3) {
            ++report.triangles_in_file;
            add({0, 1, 2});
        } else {
            polygon.clear();
            for (std::uint32_t i = 0; i < count; ++i) polygon.push_back(soup.positions[corner[i]]);
            const SplitPolygon split = split_polygon(polygon);
            count_polygon(report, split.how, face, first_faces);
            for (const auto& t : split.triangles) add(t);
        }
        if (!soup.face_materials.empty()) {
            mesh.triangle_materials.resize(mesh.triangles.size(), static_cast<std::uint8_t>(soup.face_materials[face]));
        }
    }
    return first_faces;
}

double largest_coordinate(const TriangleMesh& mesh) {
    const Box bounds = bounds_of(mesh);
    const Vec3 farthest = glm::max(glm::abs(bounds.lo), glm::abs(bounds.hi));
    return std::max({farthest.x, farthest.y, farthest.z});
}

// Moves the numbers of the file so that the middle of the box around all triangles is at the origin. Near it their
// differences are exact, so that nothing is lost by a place far away. False where some lie too far from others.
bool bring_to_middle(TriangleMesh& mesh) {
    const Vec3 middle = bounds_of(mesh).center();
    for (Vec3& p : mesh.positions_m) p -= middle;
    return std::ranges::none_of(mesh.positions_m,
                                [](const Vec3& p) { return is_far(p.x) || is_far(p.y) || is_far(p.z); });
}

// Brings the mesh, whose positions are numbers of the file, to metres. Metres stay as they are to the last bit.
void bring_to_metres(ImportedMesh& imported, std::optional<LengthUnit> given, const std::optional<StatedUnit>& stated,
                     double tolerance) {
    const Vec3 size = bounds_of(imported.mesh).extent();
    ImportReport& report = imported.report;
    report.unit = choose_unit(given, stated, std::max({size.x, size.y, size.z}));
    const LengthUnit unit = report.unit.unit;
    report.size_m = to_metres(size, unit);
    report.weld_tolerance_m = to_metres(tolerance, unit);
    if (unit == LengthUnit::m) return;
    for (Vec3& p : imported.mesh.positions_m) p = to_metres(p, unit);
}

}  // namespace

std::uint32_t ColourMaterials::index_of(const Colour& colour) {
    const auto [entry, is_new] = known_.try_emplace(packed(colour), static_cast<std::uint32_t>(materials_.size()));
    if (is_new) {
        constexpr char kDigits[] = "0123456789abcdef";
        std::string name = "#";
        for (const std::uint8_t c : colour) name += {kDigits[c >> 4], kDigits[c & 15]};
        materials_.push_back({std::move(name), colour});
    }
    return entry->second;
}

std::string at_line(const std::string& name, std::uint64_t line) { return name + ":" + std::to_string(line); }
std::string at_byte(const std::string& name, std::uint64_t byte) { return name + ", byte " + std::to_string(byte); }

const char* coordinate_fault(double number) {
    if (std::isnan(number)) return "a coordinate is not a number";
    if (std::isinf(number)) return "a coordinate is infinite";
    if (std::abs(number) > kFarthestCoordinate) return "a coordinate lies beyond 1e15";
    return nullptr;
}

void add_vertex(MeshSoup& soup, const Vec3& position, std::uint64_t place) {
    const auto vertex = static_cast<std::uint32_t>(soup.positions.size());
    soup.positions.push_back(position);
    for (int k = 0; k < 3; ++k) {
        const char* const fault = coordinate_fault(position[k]);
        if (fault == nullptr) continue;
        soup.faulty.push_back({vertex, place, fault});
        return;
    }
    if (is_far(position.x) || is_far(position.y) || is_far(position.z))
        soup.distant.push_back({vertex, place, "a coordinate lies beyond 1e9", kFarRemedy});
}

Result<ImportedMesh> finished(MeshSoup&& soup, const std::string& name, std::optional<LengthUnit> given_unit,
                              MeshOrigin origin) {
    judge_distant(soup, name, origin);
    const std::size_t faulty = soup.faulty.size();
    BURIN_TRY_DO(leave_out_faulty(soup, name));
    if (!soup.far.empty() && origin == MeshOrigin::of_file)
        return fail(soup.far, "a coordinate lies beyond 1e9", kFarRemedy);
    choose_colours(soup);
    if (soup.face_materials.empty() && !soup.colours.empty()) materials_from_vertices(soup);
    keep_colours_beyond_palette(soup);
    reduce_palette(soup);
    ImportedMesh result{{}, std::move(soup.report)};
    ImportReport& report = result.report;
    report.faces_in_file = soup.corner_counts.size();
    report.vertices_in_file = soup.positions.size() + faulty + report.vertices_merged;
    const FirstFaces first_faces = split_faces(soup, result);
    if (result.mesh.triangles.empty()) {
        return fail(name, "has no triangles", "export it again as a surface of triangles or polygons");
    }
    if (report.faces_without_area > 0) {
        report.remarks.push_back(std::to_string(report.faces_without_area) +
                                 " faces have fewer than three corners and are not in the mesh");
    }
    remark_polygons(report, first_faces);
    result.mesh.positions_m = std::move(soup.positions);
    const double largest = largest_coordinate(result.mesh);
    if (origin == MeshOrigin::middle && !bring_to_middle(result.mesh))
        return fail(soup.far.empty() ? name : soup.far, "a coordinate lies more than 1e9 from others",
                    "repair the file or export it again");
    bring_to_metres(result, given_unit, soup.stated_unit, soup.precision.weld_tolerance(largest));
    result.mesh.colours = std::move(soup.colours);
    result.mesh.materials = std::move(soup.materials);
    return result;
}

}  // namespace burin::geometry
