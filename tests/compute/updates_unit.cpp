// SPDX-License-Identifier: MIT
#include "tests/compute/updates.hpp"

namespace burin::compute::test {
namespace {

WorkerPool& update_pool() {
    static WorkerPool pool(2);
    return pool;
}

std::unique_ptr<CarvingEngine> on_cpu(const Solid& solid) { return make_cpu_engine(solid, update_pool()); }

}  // namespace

TEST(UpdatesOfTheProcessor, AreTakenOneByOne) {
    for (int round = 0; round < repeated(4); ++round)
        takes_updates_one_by_one(on_cpu, 300u + static_cast<unsigned>(round));
}

TEST(UpdatesOfTheProcessor, AreTakenAsTheyAreDone) {
    for (int round = 0; round < repeated(4); ++round)
        takes_updates_as_they_are_done(on_cpu, 400u + static_cast<unsigned>(round));
}

TEST(UpdatesOfTheProcessor, AreNotBegunWithABadSweep) { refuses_a_bad_sweep_and_begins_nothing(on_cpu); }

}  // namespace burin::compute::test
