// SPDX-License-Identifier: MIT
// libFuzzer body of the objects of a world as pages of a document (scene/saved_objects.hpp). Whatever the bytes: no
// fault, no hang; every failure has a place; what is loaded without a loss is the same when it is saved again. The
// first byte says which page of a sound world the rest takes the place of, or which bytes of it are changed.
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "scene/saved_objects.hpp"
#include "tests/fuzz/changed_file.hpp"

namespace {

using namespace burin;
using fuzz::require;

scene::Pages saved(const std::vector<scene::SceneObject>& objects) {
    std::vector<const geometry::TriangleMesh*> meshes;
    for (const scene::SceneObject& object : objects) meshes.push_back(object.mesh.get());
    const std::vector<std::size_t> numbers = scene::mesh_numbers(meshes);
    scene::Pages pages{.part = std::string(scene::kObjectsPart)};
    for (std::size_t i = 0; i < objects.size(); ++i)
        scene::save_object(objects[i], objects[i].corner_colours.get(), numbers[i],
                           scene::object_bytes(objects[i], numbers[i]), pages);
    return pages;
}

// Two objects of one mesh, one with colours of its own, the other on a path.
std::vector<scene::SceneObject> sound_objects() {
    geometry::TriangleMesh mesh;
    mesh.positions_m = {Vec3(0.0), Vec3(0.1, 0.0, 0.0), Vec3(0.0, 0.1, 0.0), Vec3(0.0, 0.0, 0.1)};
    mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    std::vector<scene::SceneObject> objects(2);
    for (std::size_t i = 0; i < 2; ++i) {
        objects[i].id = i + 1;
        objects[i].name = "object " + std::to_string(i);
        objects[i].mesh = i == 0 ? std::make_shared<const geometry::TriangleMesh>(mesh) : objects[0].mesh;
    }
    scene::CornerColours colours(4, {scene::Colour{1, 2, 3}, scene::Colour{4, 5, 6}, scene::Colour{7, 8, 9}});
    scene::take_colours(objects[0], std::move(colours));
    objects[1].motion = scene::PathMotion{{{0.0, {}}, {1.0, {Vec3(0.0, 0.1, 0.0)}}, {2.0, {}}}};
    return objects;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size < 2) return 0;
    static const std::vector<scene::SceneObject> sound = sound_objects();
    static const scene::Pages whole = saved(sound);
    scene::Pages pages = whole;
    auto at = pages.pages.begin();
    std::advance(at, data[0] % pages.pages.size());
    if (data[0] < 128) {
        const auto* bytes = reinterpret_cast<const std::byte*>(data + 1);
        at->second = {bytes, bytes + size - 1};
    } else {
        for (std::size_t i = 1; i + 3 <= size; i += 3)
            at->second[(data[i] + 256u * data[i + 1]) % at->second.size()] ^= static_cast<std::byte>(data[i + 2]);
    }
    if (const auto loaded = scene::load_objects(pages, "fuzz"); !loaded)
        require(!loaded.error().where.empty());
    else if (loaded->lost.empty())
        require(saved(scene::load_objects(saved(loaded->objects), "fuzz")->objects).pages ==
                saved(loaded->objects).pages);
    std::vector<scene::SceneObject> objects = sound;
    scene::Pages change{.part = std::string(scene::kObjectsPart), .whole = false};
    change.pages[scene::change_of(data[0] % 3)] = at->second;
    const std::vector<std::shared_ptr<const scene::CornerColours>> colours{sound[0].corner_colours, nullptr};
    if (const auto done = scene::apply_change(objects, colours, change, "fuzz"); !done)
        require(!done.error().where.empty());
    return 0;
}
