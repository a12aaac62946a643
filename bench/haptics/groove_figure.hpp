// SPDX-License-Identifier: MIT
// Two figures of a tool in the groove that it cuts (carving_scenes.hpp): how fast it sinks over how hard it is pressed,
// on lattices of several sizes, beside the law; and what holds it while it is lifted, over its height above the
// groove's floor. Another version's points can be read and are drawn beside this one's.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "bench/haptics/carving_tools.hpp"

namespace burin::bench {

// One point of a curve: "sinks", x in yields of the tool's section and y in mm/s, or "lifted", x in mm and y in N.
struct GroovePoint {
    std::string kind, tool;
    std::string what;  // "law", "now", or which version
    int resolution = 0;
    double x = 0.0, y = 0.0;
};

struct GrooveOptions {
    std::vector<CarvingTool> tools = carving_tools();
    std::vector<int> resolutions{128, 256, 512};
    std::vector<double> presses{0.9, 1.25, 1.5, 2.0, 2.5};  // in yields
    double pressed_from_m = 0.003;
    int lifted_resolution = 256;
    double lifted_at_m_per_s = 0.3;
};

// notify(line) is called before each run.
[[nodiscard]] std::vector<GroovePoint> measure_groove(const GrooveOptions& options,
                                                      const std::function<void(const std::string&)>& notify);

[[nodiscard]] std::string groove_csv(const std::vector<GroovePoint>& points);
// Reads what groove_csv() wrote, each point that is "now" there as of `version`. Fails where a line is none of those,
// and says which.
[[nodiscard]] Result<std::vector<GroovePoint>> groove_points(std::string_view csv, const std::string& name,
                                                             const std::string& version);

[[nodiscard]] std::string sinking_svg(const std::vector<GroovePoint>& points);
[[nodiscard]] std::string lifted_svg(const std::vector<GroovePoint>& points);

}  // namespace burin::bench
