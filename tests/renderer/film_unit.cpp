// SPDX-License-Identifier: MIT
// Animated PNGs are taken apart by their chunks; their first picture is read by libpng, which knows no animation.
#include "renderer/film.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "picture/png.hpp"
#include "tests/support/run_command.hpp"

namespace burin::renderer {
namespace {

// A grey picture with a square.
Image square_at(std::uint32_t x, std::uint32_t y, std::uint8_t red) {
    Image image{{64, 48}, std::vector<std::uint8_t>(std::size_t{4} * 64 * 48, 128)};
    for (std::uint32_t dy = 0; dy < 5; ++dy)
        for (std::uint32_t dx = 0; dx < 7; ++dx) image.rgba[4 * (std::size_t{y + dy} * 64 + x + dx)] = red;
    for (std::size_t i = 3; i < image.rgba.size(); i += 4) image.rgba[i] = 255;
    return image;
}

struct Chunk {
    std::string name, content;
};
std::vector<Chunk> chunks_of(const std::vector<std::byte>& file) {
    const std::string bytes(reinterpret_cast<const char*>(file.data()), file.size());
    std::vector<Chunk> chunks;
    for (std::size_t at = 8; at < bytes.size();) {
        std::uint32_t length = 0;
        for (std::size_t i = 0; i < 4; ++i) length = (length << 8) | static_cast<std::uint8_t>(bytes.at(at + i));
        chunks.push_back({bytes.substr(at + 4, 4), bytes.substr(at + 8, length)});
        at += 12 + length;
    }
    return chunks;
}
std::uint32_t number_in(const std::string& content, std::size_t at, int bytes = 4) {
    std::uint32_t number = 0;
    for (int i = 0; i < bytes; ++i)
        number = (number << 8) | static_cast<std::uint8_t>(content.at(at + static_cast<std::size_t>(i)));
    return number;
}

struct Shown {
    PixelRect rect;
    std::uint32_t ms = 0;
};
std::vector<Shown> frames_of(const std::vector<std::byte>& file) {
    std::vector<Shown> frames;
    std::uint32_t sequence = 0;
    for (const Chunk& chunk : chunks_of(file)) {
        if (chunk.name == "fcTL" || chunk.name == "fdAT") {
            EXPECT_EQ(number_in(chunk.content, 0), sequence++);
        }
        if (chunk.name != "fcTL") continue;
        const auto at = [&](std::size_t i) { return number_in(chunk.content, i); };
        EXPECT_EQ(number_in(chunk.content, 22, 2), 1000u);
        frames.push_back({{at(12), at(16), at(4), at(8)}, number_in(chunk.content, 20, 2)});
    }
    return frames;
}

}  // namespace

TEST(Film, HoldsWhatChangesAndForHowLong) {
    Film film(100);
    const std::vector<Image> pictures{square_at(3, 4, 200), square_at(3, 4, 200), square_at(20, 30, 250),
                                      square_at(20, 30, 250), square_at(20, 30, 10)};
    for (const Image& picture : pictures) ASSERT_TRUE(film.add(picture));
    EXPECT_EQ(film.pictures(), 5u);
    const auto file = film.finish();
    ASSERT_TRUE(file) << file.error().line();
    const auto chunks = chunks_of(*file);
    EXPECT_EQ(chunks.front().name, "IHDR");
    EXPECT_EQ(chunks[1].name, "acTL");
    EXPECT_EQ(number_in(chunks[1].content, 0), 3u);
    EXPECT_EQ(chunks.back().name, "IEND");
    const auto frames = frames_of(*file);
    ASSERT_EQ(frames.size(), 3u);
    EXPECT_EQ(frames[0].rect, (PixelRect{0, 0, 64, 48}));
    EXPECT_EQ(frames[0].ms, 200u);
    EXPECT_EQ(frames[1].rect, (PixelRect{3, 4, 24, 31})) << "around where the square was and where it is";
    EXPECT_EQ(frames[1].ms, 200u);
    EXPECT_EQ(frames[2].rect, (PixelRect{20, 30, 7, 5}));
    EXPECT_EQ(frames[2].ms, 100u);

    // Who knows nothing of animation sees the first picture; libpng checks the checksums of all chunks that it reads.
    Workplace place;
    std::ofstream(place / "film.png", std::ios::binary)
        .write(reinterpret_cast<const char*>(file->data()), static_cast<std::streamsize>(file->size()));
    const auto still = picture::load_png(place / "film.png");
    ASSERT_TRUE(still) << still.error().line();
    EXPECT_EQ(still->rgba, pictures[0].rgba);
}

TEST(Film, RefusesPicturesOfTwoSizesAndNone) {
    Film film(100);
    EXPECT_FALSE(Film(100).finish());
    ASSERT_TRUE(film.add(square_at(0, 0, 1)));
    EXPECT_FALSE(film.add(Image{{2, 2}, std::vector<std::uint8_t>(16, 255)}));
}

TEST(Png, IsReadAsItWasWrittenAndNonsenseIsRefusedByName) {
    Workplace place;
    const Image image = square_at(9, 9, 77);
    ASSERT_TRUE(picture::write_png(place / "a.png", image));
    const auto read = picture::load_png(place / "a.png");
    ASSERT_TRUE(read);
    EXPECT_EQ(read->rgba, image.rgba);
    place.write("b.png", "no picture");
    const auto refused = picture::load_png(place / "b.png");
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().line().find("b.png"), std::string::npos);
    EXPECT_FALSE(picture::load_png(place / "c.png")) << "it is not there";
}

}  // namespace burin::renderer
