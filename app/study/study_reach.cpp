// SPDX-License-Identifier: MIT
#include "app/study/study_reach.hpp"

#include <cstdio>

#include "base/try.hpp"
#include "study/felt/felt_world.hpp"
#include "study/felt/reach.hpp"

namespace burin::app {

Result<void> check_reach(const study::Protocol& protocol, const std::string& name) {
    std::size_t faults = 0;
    for (const study::StudyWorld& world : protocol.worlds) {
        BURIN_TRY(felt, study::FeltWorld::create(world));
        for (const study::ReachFault& fault : study::reach_faults(protocol, world, (felt)->bounds())) {
            ++faults;
            std::printf("%s: %s; %s\n", name.c_str(), fault.what.c_str(), fault.remedy.c_str());
        }
        for (const std::string& warning : study::reach_warnings(protocol, world, (felt)->bounds()))
            std::printf("%s\n", warning.c_str());
    }
    std::fflush(stdout);
    if (faults == 0) return {};
    return fail(name, "has a path that cannot be done", "correct what is listed");
}

}  // namespace burin::app
