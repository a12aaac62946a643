// SPDX-License-Identifier: MIT
// libFuzzer body of the reader of skinned meshes. Whatever the bytes: no fault, no hang, no memory beyond a multiple of
// the input; every fault has a place and a remedy; what is accepted has sound indices and weights, and is a hand or is
// refused as one. The input is taken as it is, and as the JSON part of a file whose binary part is the input as well.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "geometry/hand/hand_model.hpp"

namespace {

void require(bool condition) {
    if (!condition) std::abort();
}

void check_error(const burin::Error& error) {
    require(!error.what.empty() && !error.where.empty() && !error.remedy.empty());
}

void check_mesh(const burin::geometry::SkinnedMesh& mesh) {
    require(mesh.bindings.size() == mesh.positions_m.size());
    for (const auto& t : mesh.triangles)
        for (const std::uint32_t corner : t) require(corner < mesh.positions_m.size());
    for (const auto& binding : mesh.bindings) {
        double sum = 0.0;
        for (std::size_t k = 0; k < burin::geometry::kInfluences; ++k) {
            require(binding.joints[k] < mesh.joints.size());
            sum += binding.weights[k];
        }
        require(std::abs(sum - 1.0) < 1e-9);
    }
    const auto hand = burin::geometry::hand_model_of(mesh, "fuzz");
    if (!hand) return check_error(hand.error());
    for (const burin::Vec3& place : skinned(*hand, pose_of(*hand, {}, {}))) require(burin::finite(place));
}

void put_word(std::vector<std::byte>& bytes, std::uint32_t word) {
    for (std::size_t i = 0; i < 4; ++i) bytes.push_back(static_cast<std::byte>(word >> (8 * i)));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::span given(reinterpret_cast<const std::byte*>(data), size);
    std::vector<std::byte> framed;
    const auto whole = static_cast<std::uint32_t>(size);
    for (const std::uint32_t word : {0x46546C67u, 2u, 28u + 2u * whole, whole, 0x4E4F534Au}) put_word(framed, word);
    framed.insert(framed.end(), given.begin(), given.end());
    for (const std::uint32_t word : {whole, 0x004E4942u}) put_word(framed, word);
    framed.insert(framed.end(), given.begin(), given.end());
    for (const std::span<const std::byte> bytes : {given, std::span<const std::byte>(framed)}) {
        const auto mesh = burin::geometry::read_skinned_glb(bytes, "fuzz");
        if (mesh) {
            check_mesh(*mesh);
        } else {
            check_error(mesh.error());
        }
    }
    return 0;
}
