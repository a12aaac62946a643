// SPDX-License-Identifier: MIT
// workspace_story OUT.png: the moving algorithm's steps as the PowerWall paper's Figure 6 shows them, in six pictures
// of the wall: the tool within the workspace, at its border, the button pressed, released, the workspace dragged on,
// the ball touched and painted. A led hand at the real haptic loop; docs/pictures/workspace.png is made by this.
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>

#include "activities/carve/stroke_pictures.hpp"
#include "compute/engine/chosen_engine.hpp"
#include "compute/vulkan/engine_choice.hpp"
#include "devices/haptic/simulated_omni.hpp"
#include "haptics/channels.hpp"
#include "haptics/haptic_loop.hpp"
#include "sculpt/load_workpiece.hpp"
#include "sculpt/sculpture.hpp"
#include "toolbox/tool_mesh.hpp"
#include "toolbox/tool_options.hpp"

namespace burin {
namespace {

constexpr double kToolRadius_m = 0.006;
constexpr std::uint32_t kMoveButton = 2;

// A device that is where it is told to be.
class LedDevice final : public devices::HapticDevice {
public:
    explicit LedDevice(SimulatedClock& clock) : clock_(clock) {
        description_.name = "led by the hand";
        description_.workspace_m = devices::OmniModel{}.workspace_m;
        description_.max_force_N = devices::OmniModel{}.max_force_N;
    }
    [[nodiscard]] const devices::DeviceDescription& description() const noexcept override { return description_; }
    [[nodiscard]] devices::DeviceSample read() noexcept override {
        sample.time_ns = clock_.now_ns();
        return sample;
    }
    void write(const devices::DeviceWrench&) noexcept override {}
    devices::DeviceSample sample;

private:
    SimulatedClock& clock_;
    devices::DeviceDescription description_;
};

class LedHand {
public:
    LedHand() {
        haptics::TickParameters& parameters = channels_.parameters.draft();
        parameters.sequence = 1;
        parameters.workspace.technique = haptics::WorkspaceTechnique::moving;
        parameters.workspace.object_from_device = {{-0.212, -0.01, 0.085}, Quat{1, 0, 0, 0}, 0.5};
        parameters.workspace.button_mask = kMoveButton;
        channels_.parameters.publish();
    }
    void wait(double time_s) {
        for (int i = 0; i < static_cast<int>(std::lround(time_s * 1e3)); ++i) {
            clock_.sleep_until(clock_.now_ns() + loop_.period_ns());
            loop_.step();
        }
    }
    void go(const Vec3& to_device_m, double time_s) {
        const Vec3 from = device_.sample.position_device_m;
        const int ticks = static_cast<int>(std::lround(time_s * 1e3));
        for (int i = 1; i <= ticks; ++i) {
            const double u = static_cast<double>(i) / ticks;
            device_.sample.position_device_m = from + (to_device_m - from) * (u * u * (3.0 - 2.0 * u));
            wait(1e-3);
        }
    }
    void press() { device_.sample.buttons = kMoveButton; }
    void release() { device_.sample.buttons = 0; }
    [[nodiscard]] haptics::ToolState tool() { return channels_.tool.newest(); }
    // Where the hand has to be for the tool to be there.
    [[nodiscard]] Vec3 hand_for(const Vec3& place_object) {
        return inverse(tool().workspace.object_from_device) * place_object;
    }

private:
    SimulatedClock clock_;
    haptics::HapticChannels channels_;
    LedDevice device_{clock_};
    haptics::HapticLoop loop_{device_, clock_, channels_};
};

// A place on the ball, which lies around the origin, to the left and in front.
Vec3 on_ball(const Box& bounds, double across) {
    return 0.5 * bounds.extent().x * glm::normalize(Vec3(-0.62 + across, 0.12, 0.78));
}

class Story {
public:
    Story(sculpt::Sculpture& carving, activities::StrokePictures& pictures, toolbox::Tool paint, const Box& bounds)
        : carving_(carving), pictures_(pictures), paint_(std::move(paint)), bounds_(bounds) {}

    Result<std::vector<Image>> tell() {
        hand_.wait(0.1);
        hand_.go({-0.03, -0.02, 0.0}, 0.5);
        if (const auto taken = take(); !taken) return std::unexpected(taken.error());
        hand_.go({0.078, 0.008, 0.0}, 0.8);
        if (const auto taken = take(); !taken) return std::unexpected(taken.error());
        hand_.press();
        hand_.wait(0.15);
        if (const auto taken = take(); !taken) return std::unexpected(taken.error());
        hand_.release();
        hand_.wait(0.1);
        if (const auto taken = take(); !taken) return std::unexpected(taken.error());
        hand_.press();
        hand_.wait(0.6);
        if (const auto taken = take(); !taken) return std::unexpected(taken.error());
        hand_.release();
        hand_.wait(0.5);
        if (const auto painted = paint(); !painted) return std::unexpected(painted.error());
        if (const auto taken = take(); !taken) return std::unexpected(taken.error());
        return std::move(images_);
    }

private:
    Result<void> take() {
        auto image = pictures_.view_of_wall(
            carving_, session::staging_of(hand_.tool(), kToolRadius_m, devices::OmniModel{}.workspace_m));
        if (!image) return std::unexpected(image.error());
        images_.push_back(std::move(*image));
        return {};
    }

    Result<void> paint() {
        std::vector<compute::ToolSweep> sweeps;
        hand_.go(hand_.hand_for(on_ball(bounds_, 0.0)), 0.5);
        for (double across = 0.02; across < 0.25; across += 0.02) {
            const Pose from{hand_.tool().proxy_object_m, Quat{1, 0, 0, 0}};
            hand_.go(hand_.hand_for(on_ball(bounds_, across)), 0.05);
            sweeps.push_back(paint_.sweep(from, {hand_.tool().proxy_object_m, Quat{1, 0, 0, 0}}));
        }
        return carving_.update(sweeps);
    }

    sculpt::Sculpture& carving_;
    activities::StrokePictures& pictures_;
    toolbox::Tool paint_;
    Box bounds_;
    LedHand hand_;
    std::vector<Image> images_;
};

// Three across, each half as large, with a line of white between.
Image montage(const std::vector<Image>& images) {
    constexpr std::uint32_t kAcross = 3, kGap = 6;
    const std::uint32_t width = images[0].size.width / 2, height = images[0].size.height / 2;
    const auto down = static_cast<std::uint32_t>((images.size() + kAcross - 1) / kAcross);
    Image all{{kAcross * width + (kAcross - 1) * kGap, down * height + (down - 1) * kGap}, {}};
    all.rgba.assign(std::size_t{4} * all.size.width * all.size.height, 255);
    for (std::uint32_t i = 0; i < images.size(); ++i) {
        const std::uint32_t left = i % kAcross * (width + kGap), top = i / kAcross * (height + kGap);
        for (std::uint32_t y = 0; y < height; ++y) {
            for (std::uint32_t x = 0; x < width; ++x) {
                std::uint8_t* to = all.rgba.data() + 4 * (std::size_t{top + y} * all.size.width + left + x);
                for (int c = 0; c < 3; ++c) {
                    const Image& from = images[i];
                    const int sum = from.pixel(2 * x, 2 * y)[c] + from.pixel(2 * x + 1, 2 * y)[c] +
                                    from.pixel(2 * x, 2 * y + 1)[c] + from.pixel(2 * x + 1, 2 * y + 1)[c];
                    to[c] = static_cast<std::uint8_t>((sum + 2) / 4);
                }
            }
        }
    }
    return all;
}

Box bounds_of(const compute::Lattice& lattice) {
    const Vec3 inset(1.5 * lattice.spacing_m);  // about so much is empty around the workpiece
    const Vec3 size = Vec3(lattice.cells[0], lattice.cells[1], lattice.cells[2]) * lattice.spacing_m;
    return {lattice.origin_object + inset, lattice.origin_object + size - inset};
}

Result<void> make(const std::filesystem::path& file) {
    const toolbox::ToolOptions options{.shape = "ball:" + std::to_string(kToolRadius_m),
                                       .operation = compute::Operation::paint,
                                       .material = "200,40,30"};
    const Result<toolbox::ToolSettings> settings = toolbox::parse_tool_settings(options);
    if (!settings) return std::unexpected(settings.error());
    Result<toolbox::Tool> tool = toolbox::make_tool(*settings);
    if (!tool) return std::unexpected(tool.error());
    WorkerPool pool(0);
    Result<workpiece::LoadedWorkpiece> workpiece =
        sculpt::load_workpiece({"assets/workpieces/soccer_ball.obj", 256, false}, pool);
    if (!workpiece) return std::unexpected(workpiece.error());
    tool->material = static_cast<std::uint8_t>(workpiece->solid.materials.size());
    workpiece->solid.materials.push_back(toolbox::material_of(*settings));
    const Box bounds = bounds_of(workpiece->solid.lattice);
    compute::ChosenEngine chosen =
        compute::choose_engine(compute::EngineChoice::cpu, std::move(workpiece->solid), pool);
    sculpt::Sculpture carving(std::move(chosen.engine), pool);
    Result<activities::StrokePictures> pictures =
        activities::StrokePictures::create(std::filesystem::absolute(file).parent_path(), bounds);
    if (!pictures) return std::unexpected(pictures.error());
    const auto images = Story(carving, *pictures, std::move(*tool), bounds).tell();
    if (!images) return std::unexpected(images.error());
    return picture::write_png(file, montage(*images));
}

}  // namespace
}  // namespace burin

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fputs("usage, in the repository's root: workspace_story OUT.png\n", stderr);
        return 2;
    }
    const auto done = burin::make(argv[1]);
    if (!done) std::fprintf(stderr, "workspace_story: %s\n", done.error().line().c_str());
    return done ? 0 : 1;
}
