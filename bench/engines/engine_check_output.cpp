// SPDX-License-Identifier: MIT
#include <array>
#include <cstdio>

#include "bench/engines/engine_check.hpp"

namespace burin::bench {
namespace {

std::string check_line(const char* format, auto... values) {
    std::array<char, 512> text{};
    std::snprintf(text.data(), text.size(), format, values...);
    return text.data();
}

std::string work_row(const ComparedWork& work) {
    return check_line("  %-20s%12s%13s%13s%13s%9s%13s%9s\n", work.name.c_str(), std::to_string(work.operations).c_str(),
                      std::to_string(work.submissions).c_str(), std::to_string(work.rays).c_str(),
                      std::to_string(work.ends).c_str(), std::to_string(work.ends_that_differ).c_str(),
                      std::to_string(work.elements).c_str(), std::to_string(work.elements_that_differ).c_str());
}

Json work_json(const ComparedWork& work) {
    return {{"operations", work.operations},
            {"submissions", work.submissions},
            {"rays_compared", work.rays},
            {"ends_compared", work.ends},
            {"ends_that_differ", work.ends_that_differ},
            {"surface_elements_compared", work.elements},
            {"surface_elements_that_differ", work.elements_that_differ}};
}

}  // namespace

std::string engine_check_table(const EngineCheck& check) {
    std::string text = "the processor's engine (" + std::to_string(check.threads) + " threads) beside " + check.device +
                       (check.software_device ? ", a software device" : "") + ", " + check.driver + "\nseed " +
                       std::to_string(check.options.seed) + ", " + std::to_string(check.options.resolution) +
                       " cells, solids: " + std::to_string(check.solids) + "\n\n";
    text += check_line("  %-20s%12s%13s%13s%13s%9s%13s%9s\n", "", "operations", "submissions", "rays", "ends", "differ",
                       "surface", "differ");
    for (const ComparedWork& work : check.work)
        if (work.operations > 0) text += work_row(work);
    ComparedWork all = check.all;
    all.name = "together";
    text += work_row(all) + "\n";
    for (const std::string& notice : check.notices) text += notice + "\n";
    text += check.all.ends_that_differ == 0 ? "no end differs\n"
                                            : std::to_string(check.all.ends_that_differ) +
                                                  " ends differ, the first of them: " + check.first_difference + "\n";
    return text + (check.all.elements_that_differ == 0
                       ? "no vertex and no triangle of the surface differs\n"
                       : std::to_string(check.all.elements_that_differ) +
                             " vertices and triangles of the surface differ, the first of them: " +
                             check.first_element_that_differs + "\n");
}

Json engine_check_json(const EngineCheck& check) {
    Json json = {{"device", check.device},
                 {"driver", check.driver},
                 {"software_device", check.software_device},
                 {"threads", check.threads},
                 {"seed", check.options.seed},
                 {"resolution", check.options.resolution},
                 {"solids", check.solids},
                 {"all", work_json(check.all)},
                 {"first_difference", check.first_difference.empty() ? Json(nullptr) : Json(check.first_difference)},
                 {"first_surface_difference",
                  check.first_element_that_differs.empty() ? Json(nullptr) : Json(check.first_element_that_differs)},
                 {"notices", check.notices},
                 {"submissions", check.traffic.submissions},
                 {"blocking_waits", check.traffic.blocking_waits},
                 {"bytes_to_device", check.traffic.bytes_to_device},
                 {"bytes_to_host", check.traffic.bytes_to_host},
                 {"device_memory_bytes", check.traffic.most_memory_bytes}};
    for (const ComparedWork& work : check.work) {
        Json row = {{"work", work.name}};
        row.update(work_json(work));
        json["by_work"].push_back(std::move(row));
    }
    return json;
}

}  // namespace burin::bench
