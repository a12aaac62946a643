// SPDX-License-Identifier: MIT
// A 2D image of one or more layers with a view of all of them. Each image is one memory allocation. Ownership:
// move-only; freed when the GPU no longer uses it. Thread and lifetime: as Device.
#pragma once

#include <cstdint>
#include <string>

#include "gpu/core.hpp"

namespace burin::gpu {

struct ImageSpec {
    std::uint32_t width = 0, height = 0;  // pixels, each 1 to capabilities().max_image_size
    std::uint32_t layers = 1;             // with more than one, the view is an array view
    std::uint32_t samples = 1;            // 1 or capabilities().msaa_samples
    VkFormat format = VK_FORMAT_UNDEFINED;
    VkImageUsageFlags usage = 0;
    VkImageAspectFlags aspect = VK_IMAGE_ASPECT_COLOR_BIT;
    bool other_formats = false;  // view_as() may reinterpret it in another format of the same size
    std::string name = "image";  // for error messages
};

class Image {
public:
    Image() = default;
    [[nodiscard]] static Result<Image> create(Device& device, const ImageSpec& spec);

    [[nodiscard]] VkImage raw() const { return image_.raw(); }
    [[nodiscard]] VkImageView view() const { return view_.raw(); }
    // Creates another view of all layers in the given format.
    [[nodiscard]] Result<ImageViewHandle> view_as(Device& device, VkFormat format) const;

private:
    MemoryHandle memory_;  // destroyed last
    ImageHandle image_;
    ImageViewHandle view_;
    VkImageAspectFlags aspect_ = 0;
    std::uint32_t layers_ = 1;
};

}  // namespace burin::gpu
