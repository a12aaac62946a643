// SPDX-License-Identifier: MIT
#include "app/study/study_reach.hpp"

#include <cstdio>

#include "base/try.hpp"
#include "study/felt/reach.hpp"

namespace burin::app {

Result<void> check_reach(const study::Protocol& protocol, const std::string& name) {
    BURIN_TRY(worlds, study::reach_of(protocol));
    std::size_t faults = 0;
    for (const study::WorldReach& world : worlds) {
        faults += world.faults.size();
        for (const study::ReachFault& fault : world.faults)
            std::printf("%s: %s; %s\n", name.c_str(), fault.what.c_str(), fault.remedy.c_str());
        for (const std::string& warning : world.warnings) std::printf("%s\n", warning.c_str());
    }
    std::fflush(stdout);
    if (faults == 0) return {};
    return fail(name, "has a path that cannot be done", "correct what is listed");
}

}  // namespace burin::app
