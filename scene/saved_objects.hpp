// SPDX-License-Identifier: MIT
// The objects of a world as pages of a document.
//
//   object    page I, JSON: the values of the object with the id I, and the number of its mesh
//   mesh      page M of piece P is number M * 4096 + P: little-endian u64, how many vertices and triangles there are;
//             then x, y, z of each vertex, f64, in metres; then the three vertices of each triangle, u32. Meshes are
//             numbered from 0, and objects share them. What is more than kMostPieceBytes goes on in the next piece.
//   object I  in a change of a journal: the values that the object has from then on, as in its page
//   was I, is I   in a step of undo, by the step's number: the values of the object before and after it
//   colours   page I, pieces as of a mesh: three sRGB colours, of three bytes each, for each triangle of the object
//
// Meshes and colours of a file's own stay as long as the world does, so an update writes pages of objects alone.
// Hardest case: a page that is damaged. An object without its page, or without its mesh, keeps its number, and is there
// as an empty one that is neither seen nor felt; the others are whole.
// Frames: as of SceneObject. Pure; any thread.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "scene/object_step.hpp"
#include "scene/pages.hpp"
#include "scene/scene_object.hpp"

namespace burin::scene {

inline constexpr std::string_view kObjectsPart = "objects";
inline constexpr std::size_t kMostPieceBytes = std::size_t{16} << 20;

// Returns the page of an object's values; its mesh is known by this number. One that a hand holds is saved as fixed in
// its pose.
[[nodiscard]] std::vector<std::byte> object_bytes(const SceneObject& object, std::size_t mesh);

// Puts an object's values, and where all pages are wanted also its mesh and the colours of its file, into the pages;
// null: it has none. They are there for an object that has been given one colour as well, since that can be undone.
void save_object(const SceneObject& object, const CornerColours* of_file, std::size_t mesh,
                 std::vector<std::byte> values, Pages& pages);

// Returns the number of each mesh: one that several objects share has one number.
[[nodiscard]] std::vector<std::size_t> mesh_numbers(std::span<const geometry::TriangleMesh* const> meshes);

struct LoadedObjects {
    std::vector<SceneObject> objects;  // numbered from 1
    // Of each object's file, whether it wears them or not; null: it has none.
    std::vector<std::shared_ptr<const CornerColours>> colours = {};
    std::string lost = {};  // what was damaged, in words; empty: nothing was
};
// Makes the objects of a document's pages. Fails where there is not one whole object, and where there are more than a
// world may have. `where` names the document in messages.
[[nodiscard]] Result<LoadedObjects> load_objects(const Pages& pages, const std::string& where);

// Names the page of an object's values in a change.
[[nodiscard]] PageName change_of(ObjectId id);
// Gives objects the values of the pages of a change, which has no others; colours: of their files. One that is lost
// stays so. Fails, and changes nothing, where a page is damaged or of an object that there is not.
[[nodiscard]] Result<void> apply_change(std::vector<SceneObject>& objects,
                                        std::span<const std::shared_ptr<const CornerColours>> colours,
                                        const Pages& change, const std::string& where);

// Puts a step of this number into pages; mesh: of its object.
void save_step(const ObjectStep& step, std::int64_t number, std::size_t mesh,
               std::map<PageName, std::vector<std::byte>>& pages);
// Returns the step of these pages, each numbered 0. The objects are those of the document, the colours of their files.
// Fails where a page is damaged, or of an object that there is not.
[[nodiscard]] Result<ObjectStep> step_in(std::span<const SceneObject> objects,
                                         std::span<const std::shared_ptr<const CornerColours>> colours,
                                         const Pages& step, const std::string& where);

}  // namespace burin::scene
