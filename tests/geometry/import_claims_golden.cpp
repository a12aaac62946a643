// SPDX-License-Identifier: MIT
// Files that claim more than they hold, and hostile ones that fuzzing found: refused or read without memory for a
// claim. This program counts every byte that operator new hands out.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "geometry/mesh/mesh_health.hpp"
#include "geometry/mesh/mesh_repair.hpp"
#include "tests/geometry/mesh_samples.hpp"

namespace {
std::atomic<std::uint64_t> g_bytes_asked{0};
}

// Not inlined: otherwise the compiler sees malloc here and operator delete elsewhere, and takes it for a mismatch.
[[gnu::noinline]] void* operator new(std::size_t size) {
    g_bytes_asked.fetch_add(size, std::memory_order_relaxed);
    if (void* memory = std::malloc(size == 0 ? 1 : size)) return memory;
    throw std::bad_alloc();
}
void* operator new[](std::size_t size) { return ::operator new(size); }
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }

namespace burin::geometry::test {
namespace {

// All bytes ever asked for, freed or not, which bounds the peak from above. A vector that grows by doubling asks for
// four times its final size in all; a triangle of few bytes of text becomes some dozens of bytes: 400 covers the worst
// (short faces of OBJ with a colour each), and 64 KiB the fixed tables and messages.
std::uint64_t bytes_asked_for_importing(std::span<const std::byte> bytes, MeshFormat format) {
    const std::uint64_t before = g_bytes_asked.load();
    const auto result = import_mesh(bytes, format, "test");
    static_cast<void>(result);
    return g_bytes_asked.load() - before;
}

void expect_modest(std::string_view text, MeshFormat format) {
    const auto bytes = bytes_of(text);
    EXPECT_LE(bytes_asked_for_importing(bytes, format), 65536u + 400u * bytes.size()) << text.substr(0, 200);
}

const char* const kHugeCounts[] = {
    "100", "65536", "100000000", "2147483647", "4294967295", "9223372036854775807", "18446744073709551615"};

TEST(Claims, OfABinaryStlAreNotAllocated) {
    for (const std::uint32_t claimed : {2u, 1000000u, 0x7FFFFFFFu, 0xFFFFFFFFu}) {
        const float corners[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
        const auto bytes = binary_stl(corners, claimed);
        EXPECT_LE(bytes_asked_for_importing(bytes, MeshFormat::stl), 65536u);
    }
}

TEST(Claims, OfAPlyHeaderAreNotAllocated) {
    const std::string end = "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    for (const std::string count : kHugeCounts) {
        for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
            const std::string head = std::string("ply\nformat ") + format + " 1.0\n";
            const std::string xyz = "property float x\nproperty float y\nproperty float z\n";
            expect_modest(head + "element vertex " + count + "\n" + xyz + "element face 1\n" + end, MeshFormat::ply);
            expect_modest(head + "element vertex 3\n" + xyz + "element face " + count + "\n" + end, MeshFormat::ply);
            expect_modest(head + "element vertex " + count + "\n" + "element face 1\n" + end, MeshFormat::ply);
        }
    }
}

TEST(Claims, OfAPlyListAreNotAllocated) {
    const std::string head =
        "\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n";
    for (const std::string count : kHugeCounts) {
        expect_modest("ply\nformat ascii 1.0" + head + "property list uint int vertex_indices\nend_header\n0 0 0\n" +
                          count + " 0 0 0\n",
                      MeshFormat::ply);
    }
    expect_modest("ply\nformat binary_little_endian 1.0" + head +
                      "property list uint int vertex_indices\nend_header\n" + std::string(12, '\0') +
                      "\xff\xff\xff\xff" + std::string(12, '\0'),
                  MeshFormat::ply);
    expect_modest("ply\nformat binary_little_endian 1.0" + head +
                      "property list double uchar vertex_indices\nend_header\n" + std::string(12, '\0') +
                      std::string("\0\0\0\0\0\0\xf0\x7f", 8) + std::string(12, '\0'),
                  MeshFormat::ply);
}

TEST(Claims, OfAnOffFileAreNotAllocated) {
    for (const std::string count : kHugeCounts) {
        expect_modest("OFF\n" + count + " 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", MeshFormat::off);
        expect_modest("OFF\n3 " + count + " 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", MeshFormat::off);
        expect_modest("OFF\n" + count + " " + count + " " + count + "\n", MeshFormat::off);
        expect_modest("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n" + count + " 0 1 2\n", MeshFormat::off);
    }
}

TEST(Claims, OfObjIndicesAreNotAllocated) {
    for (const std::string count : kHugeCounts)
        expect_modest("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 " + count + "\n", MeshFormat::obj);
}

// Text of the densest kind, at a size where a fixed amount no longer hides a factor.
TEST(Memory, StaysASmallMultipleOfTheFile) {
    std::string obj = "v 0 0 0 1 1 1\n", off = "OFF\n1 20000 0\n0 0 0\n", paints, strange;
    for (int i = 0; i < 20000; ++i) {
        obj += "f 1 1 1\n";
        off += "0\n";
        paints += "usemtl " + std::to_string(i) + "\nf 1 1 1\n";
        strange += "mtllib " + std::to_string(i) + "\n";
    }
    expect_modest(obj, MeshFormat::obj);
    expect_modest(off, MeshFormat::off);
    expect_modest("v 0 0 0\n" + paints, MeshFormat::obj);
    expect_modest(strange, MeshFormat::obj);
}

}  // namespace
}  // namespace burin::geometry::test
