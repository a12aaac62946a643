// SPDX-License-Identifier: MIT
#include "renderer/frame/damage_rectangles.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace burin::renderer {
namespace {

constexpr std::uint32_t kCell_px = 16;
// Cost of drawing one more rectangle, in pixels: it takes a pass
// of its own, and what crosses its edges is processed twice.
constexpr std::int64_t kPrice_px = 4096;
constexpr std::int64_t kMostOfAll = 80;  // percent of the picture's area beyond which all of it is redrawn

std::int64_t area(const PixelRect& r) { return std::int64_t{r.width} * r.height; }

// The picture as a grid of cells, each damaged or not; the last column and row may be narrower.
class Cells {
public:
    explicit Cells(ImageSize size)
        : size_(size),
          columns_((size.width + kCell_px - 1) / kCell_px),
          rows_((size.height + kCell_px - 1) / kCell_px),
          wanted_(std::size_t{columns_} * rows_) {}

    void add(const PixelRect& r) {
        if (r.empty()) return;
        for (std::uint32_t y = r.y / kCell_px; y <= (r.y + r.height - 1) / kCell_px; ++y)
            for (std::uint32_t x = r.x / kCell_px; x <= (r.x + r.width - 1) / kCell_px; ++x)
                wanted_[std::size_t{y} * columns_ + x] = true;
    }

    // Returns rectangles of damaged cells: runs within a row, merged with runs of the same extent in the rows below.
    [[nodiscard]] std::vector<PixelRect> runs() const {
        std::vector<PixelRect> made;
        for (std::uint32_t y = 0; y < rows_; ++y)
            for (std::uint32_t x = 0; x < columns_;) {
                std::uint32_t end = x;
                while (end < columns_ && wanted_[std::size_t{y} * columns_ + end]) ++end;
                if (end > x) add_run(made, pixels(x, y, end));
                x = std::max(end, x + 1);
            }
        return made;
    }

private:
    [[nodiscard]] PixelRect pixels(std::uint32_t from, std::uint32_t row, std::uint32_t end) const {
        const std::uint32_t x = from * kCell_px, y = row * kCell_px;
        return {x, y, std::min(end * kCell_px, size_.width) - x, std::min(y + kCell_px, size_.height) - y};
    }
    static void add_run(std::vector<PixelRect>& made, const PixelRect& run) {
        const auto above = std::ranges::find_if(
            made, [&](const PixelRect& r) { return r.x == run.x && r.width == run.width && r.y + r.height == run.y; });
        if (above != made.end()) {
            above->height += run.height;
        } else {
            made.push_back(run);
        }
    }

    ImageSize size_;
    std::uint32_t columns_ = 0, rows_ = 0;
    std::vector<bool> wanted_;
};

// Returns the two rectangles whose merging saves most, if any saves anything.
std::optional<std::pair<std::size_t, std::size_t>> best_pair(const std::vector<PixelRect>& parts) {
    std::optional<std::pair<std::size_t, std::size_t>> best;
    std::int64_t least = kPrice_px;
    for (std::size_t i = 0; i < parts.size(); ++i)
        for (std::size_t j = i + 1; j < parts.size(); ++j) {
            const std::int64_t more = area(around(parts[i], parts[j])) - area(parts[i]) - area(parts[j]);
            if (more >= least) continue;
            least = more;
            best = {i, j};
        }
    return best;
}

// Returns the smallest rectangle around the given rectangles' parts inside `part`.
PixelRect within(const PixelRect& part, std::span<const PixelRect> rects) {
    PixelRect wanted;
    for (const PixelRect& r : rects) wanted = around(wanted, common(part, r));
    return wanted;
}

}  // namespace

std::vector<PixelRect> damage_rectangles(std::span<const PixelRect> rects, ImageSize size) {
    Cells cells(size);
    for (const PixelRect& r : rects) cells.add(r);
    std::vector<PixelRect> parts = cells.runs();
    while (const auto pair = best_pair(parts)) {
        parts[pair->first] = around(parts[pair->first], parts[pair->second]);
        parts.erase(parts.begin() + static_cast<std::ptrdiff_t>(pair->second));
    }
    for (PixelRect& part : parts) part = within(part, rects);  // cells at its edges may be damaged only in part
    std::int64_t sum = 0;
    for (const PixelRect& part : parts) sum += area(part);
    if (100 * sum > kMostOfAll * area(all_of(size))) return {all_of(size)};
    return parts;
}

}  // namespace burin::renderer
