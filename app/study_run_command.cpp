// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdio>

#include "app/study_command.hpp"
#include "app/study_trials.hpp"
#include "base/text.hpp"
#include "study/assign/allocation.hpp"
#include "study/folder/study_folder.hpp"
#include "study/people/recorded_trial.hpp"

namespace burin::app {
namespace {

// Streams of random numbers: 0 to kMostStrata are the allocation's.
constexpr std::uint64_t kCodesStream = 1'000'000, kPeopleStream = 2'000'000, kStagesStream = 10'000'000;
constexpr std::uint64_t kStagesOfPerson = 10'000;

// Fills the places that nobody has, with codes drawn at random from strata that have room.
Result<void> enrol_learners(study::StudyFolder& study) {
    const auto strata = study::combinations(study.protocol().strata);
    const std::size_t wanted = study.facts().participants;
    for (std::size_t n = study.participants().size(); n < wanted; ++n) {
        study::Random random(study.facts().seed, kCodesStream + n);
        const std::size_t drawn = random.below(strata.size());
        const std::string id = formatted("sim%03zu", n + 1);
        if (const auto made = study.enrol(id, strata[drawn], true); !made) return std::unexpected(made.error());
    }
    return {};
}

struct Went {
    std::size_t stages = 0, ticks = 0;
};

// The random numbers of a stage depend on the person and the stage alone: a run that was interrupted goes on as it
// would have done.
Result<Went> take_through(study::StudyFolder& study, const study::Participant& person, std::size_t index,
                          const study::LearnerPopulation& population) {
    const study::Protocol& protocol = study.protocol();
    study::Random of_person(study.facts().seed, kPeopleStream + index);
    study::Learner learner = study::draw_learner(population, person.group == protocol.groups.front().code, of_person);
    Went went;
    std::size_t number = 0;
    for (const study::StagePlace& at : study::places_of(protocol)) {
        const std::uint64_t stream = kStagesStream + index * kStagesOfPerson + number++;
        if (!person.has_ended(at.day, at.place)) {
            study::Random random(study.facts().seed, stream);
            if (const auto ok = study.begin_stage(person.id, at); !ok) return std::unexpected(ok.error());
            const study::SimulatedStage stage = study::simulate_stage(protocol, *at.stage, learner, population, random);
            const study::StudyWorld* world = protocol.world(at.stage->world);
            const bool trial = at.stage->kind == study::StageKind::trial && world != nullptr;
            const Json record = trial ? study::trial_record(*world, stage) : Json();
            if (const auto ok = study.end_stage(person.id, at, study::name_of(stage.end.result), record); !ok)
                return std::unexpected(ok.error());
            ++went.stages;
            went.ticks += stage.ticks;
        }
        learner = study::after_stage(learner, *at.stage);
    }
    return went;
}

}  // namespace

Result<void> study_run(const StudyRunOptions& options) {
    if (!options.simulated)
        return fail("burin study run", "takes only simulated learners through a study so far", "add --simulated");
    auto study = study::StudyFolder::open(options.study, study::StudyAccess::write);
    if (!study) return std::unexpected(study.error());
    warn_of_journal(*study);
    if (const auto ok = study->begin_simulation(options.effect); !ok) return ok;
    std::printf("Simulated learners: no person, no device, no force; effect %g SD.\n", options.effect);
    if (const auto ok = enrol_learners(*study); !ok) return ok;
    study::LearnerPopulation population;
    population.effect = options.effect;
    const std::vector<study::Participant> people = study->participants();
    Went all;
    for (std::size_t i = 0; i < people.size(); ++i) {
        if (!people[i].simulated || people[i].withdrawn) continue;
        const auto went = take_through(*study, people[i], i, population);
        if (!went) return std::unexpected(went.error());
        all.stages += went->stages;
        all.ticks += went->ticks;
        if (went->stages > 0)
            std::printf("%s (%s): %zu stages\n", people[i].id.c_str(), people[i].group.c_str(), went->stages);
        std::fflush(stdout);
    }
    const auto made = make_trials(options.study);
    if (!made) return std::unexpected(made.error());
    std::printf("%zu stages, %.0f s of simulated time; %s/trials.csv: %zu trials\n", all.stages,
                static_cast<double>(all.ticks) / study::kSimulatedRate_Hz, options.study.c_str(), made->trials);
    return {};
}

}  // namespace burin::app
