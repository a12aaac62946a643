// SPDX-License-Identifier: MIT
#include "activities/train/simulated_study.hpp"

#include <algorithm>
#include <atomic>
#include <iterator>
#include <map>
#include <memory>
#include <mutex>
#include <thread>

#include "activities/train/simulated_stage.hpp"
#include "base/text.hpp"
#include "base/try.hpp"
#include "study/assign/allocation.hpp"
#include "study/folder/interruption.hpp"
#include "study/folder/stage_recording.hpp"

namespace burin::activities {
namespace {

// Streams of random numbers: 0 to kMostStrata are the allocation's.
constexpr std::uint64_t kCodesStream = 1'000'000, kPeopleStream = 2'000'000, kDelaysStream = 3'000'000,
                        kStagesStream = 10'000'000;
constexpr std::uint64_t kStagesOfPerson = 10'000;
// A block of ticks and a transaction: of so much simulated time, and no longer apart by the clock on the wall. A
// quarter of the second that a kill may cost: on a busy machine two transactions may take a good part of the rest.
constexpr Nanoseconds kBlock_ns = kNanosecondsPerSecond / 4;
constexpr double kSecondsAnHour = 3600.0;

// Fills the places that nobody has, with codes drawn at random from strata that have room.
Result<void> enrol_learners(study::StudyFolder& study) {
    const auto strata = study::combinations(study.protocol().strata);
    const std::size_t wanted = study.facts().participants;
    for (std::size_t n = study.participants().size(); n < wanted; ++n) {
        study::Random random(study.facts().seed, kCodesStream + n);
        const std::size_t drawn = random.below(strata.size());
        const std::string id = formatted("sim%03zu", n + 1);
        BURIN_TRY_DO(study.enrol(id, strata[drawn], true));
    }
    return {};
}

// Checks learners whose stage was interrupted longer ago than the protocol allows; persons are not asked about.
Result<void> check_resumptions(study::StudyFolder& study, bool resumes_late) {
    const std::int64_t now_ns = study::now_utc_ns();
    for (const study::Participant& person : study.participants()) {
        if (!person.simulated) continue;
        const auto late = study::late_resumption(study, person, now_ns);
        if (!late) continue;
        if (!resumes_late) return study::check_resumption(study, person, now_ns);
        BURIN_TRY_DO(study.note_deviation(person.id, late->text(study.protocol())));
    }
    return {};
}

// Shares the folder among the threads, one of which writes at a time, and counts how far all of them have come.
class SharedStudy {
public:
    SharedStudy(study::StudyFolder& study, const FeltWorlds& worlds, const SimulationOptions& options)
        : study_(study), worlds_(worlds), options_(options), people_(study.participants()) {
        population_.effect = options.effect;
    }

    // Until nobody is left, or something has failed.
    void work() {
        while (!has_failed()) {
            const std::size_t i = next_.fetch_add(1);
            if (i >= people_.size()) return;
            if (!people_[i].simulated || people_[i].withdrawn) continue;
            const auto went = take_through(people_[i], i);
            const std::lock_guard lock(mutex_);
            if (!went) {
                if (!failure_) failure_ = went.error();
                return;
            }
            all_.stages += went->stages;
            all_.ticks += went->ticks;
            all_.simulated_s += went->simulated_s;
            if (went->stages > 0 && options_.tell)
                options_.tell(
                    formatted("%s (%s): %zu stages", people_[i].id.c_str(), people_[i].group.c_str(), went->stages));
        }
    }
    [[nodiscard]] Result<SimulationFigures> result() const {
        if (failure_) return std::unexpected(*failure_);
        return all_;
    }

private:
    [[nodiscard]] bool has_failed() {
        const std::lock_guard lock(mutex_);
        return failure_.has_value();
    }

    Result<SimulationFigures> take_through(const study::Participant& person, std::size_t index) {
        const study::Protocol& protocol = study_.protocol();
        study::Random of_person(study_.facts().seed, kPeopleStream + index);
        study::Random of_delays(study_.facts().seed, kDelaysStream + index);
        study::Learner learner =
            study::draw_learner(population_, person.group == protocol.groups.front().code, of_person);
        SimulationFigures went;
        std::size_t number = 0, day = 1;
        double clock_s = 0.0;
        for (const study::StagePlace& at : study::places_of(protocol)) {
            if (at.day != day) {
                day = at.day;
                const study::Day& next = protocol.days[day - 1];
                const double share = of_delays.uniform();
                const double delay_h = next.least_delay_h + share * (next.most_delay_h - next.least_delay_h);
                if (study::day_verdict(protocol, day, delay_h) != study::DayVerdict::in_time)
                    return fail(person.id,
                                formatted("comes %g h after the day before, out of the protocol's bounds", delay_h));
                clock_s += kSecondsAnHour * delay_h;
            }
            const std::uint64_t stream = kStagesStream + index * kStagesOfPerson + number++;
            if (!person.has_ended(at.day, at.place)) {
                study::Random random(study_.facts().seed, stream);
                BURIN_TRY(stage, go_through(person, at, learner, random, clock_s));
                ++went.stages;
                went.ticks += stage.ticks;
                went.simulated_s += stage.duration_s;
                clock_s += stage.duration_s;
            } else {
                clock_s = std::max(clock_s, ended_at_s(person, at));
            }
            learner = study::after_stage(learner, *at.stage);
        }
        return went;
    }

    // The person's clock after a stage that an earlier run ended.
    static double ended_at_s(const study::Participant& person, const study::StagePlace& at) {
        for (const study::StageVisit& v : person.visits) {
            if (v.day == at.day && v.place == at.place && v.ended_clock_s) return *v.ended_clock_s;
        }
        return 0.0;
    }

    Result<EndedStage> go_through(const study::Participant& person, const study::StagePlace& at,
                                  const study::Learner& learner, study::Random& random, double clock_s) {
        const study::Protocol& protocol = study_.protocol();
        const auto world = worlds_.find(at.stage->world);
        const auto group = std::ranges::find(protocol.groups, person.group, &study::Group::code);
        const StageInputs in{protocol, at, *group, worlds_, learner, population_};
        const bool has_motion = world != worlds_.end() && at.stage->records && options_.records;
        const auto files = [&] {
            const std::lock_guard lock(mutex_);
            return study_.begin_stage(person.id, at, has_motion, clock_s);
        }();
        if (!files) return std::unexpected(files.error());
        std::unique_ptr<study::StageRecording> recording;
        if (has_motion) {
            const study::StageTouch touch(protocol, *at.stage, *group, *world->second);
            auto facts =
                study::facts_of_stage(study_.facts().protocol_digest, *group, *at.stage, *world->second, touch);
            const study::HeldDevice held{study::kLearnersDevice, study::Hand::learner};
            std::ranges::move(study::facts_of_hand(person.id, held), std::back_inserter(facts));
            facts.insert(facts.end(), options_.provenance.begin(), options_.provenance.end());
            facts.emplace_back(study::kTicksFact, study::kTicksOfSession);
            BURIN_TRY(made, study::StageRecording::create(study_.path() / files->recording, touch, std::move(facts),
                                                          kBlock_ns));
            recording = std::move(made);
        }
        BURIN_TRY(stage, simulate_stage(in, random,
                                        [&](const haptics::TickRecord& record, study::OperatorAct act,
                                            const study::StageSession& session) {
                                            if (recording) recording->take(record, act, session);
                                        }));
        if (recording) {
            BURIN_TRY_DO(recording->close());
        }
        const std::lock_guard lock(mutex_);
        if (const auto deviation = deviation_of(at, stage)) BURIN_TRY_DO(study_.note_deviation(person.id, *deviation));
        BURIN_TRY_DO(study_.end_stage(person.id, at, study::name_of(stage.end.result), stage.record, *files,
                                      failures_of(*at.stage, stage), clock_s + stage.duration_s));
        return stage;
    }

    study::StudyFolder& study_;
    const FeltWorlds& worlds_;
    const SimulationOptions& options_;
    std::vector<study::Participant> people_;
    study::LearnerPopulation population_;
    std::atomic<std::size_t> next_{0};
    std::mutex mutex_;  // guards study_ and what follows
    SimulationFigures all_;
    std::optional<Error> failure_;
};

}  // namespace

Result<SimulationFigures> run_simulated(study::StudyFolder& study, const SimulationOptions& options) {
    BURIN_TRY_DO(check_resumptions(study, options.resumes_late));
    BURIN_TRY_DO(study.begin_simulation(options.effect));
    BURIN_TRY_DO(enrol_learners(study));
    BURIN_TRY(worlds, felt_worlds(study.protocol()));
    SharedStudy shared(study, worlds, options);
    const unsigned cores = std::max(1u, std::thread::hardware_concurrency());
    const unsigned wanted = options.threads > 0 ? options.threads : cores;
    const auto threads = static_cast<unsigned>(
        std::clamp<std::size_t>(wanted, 1, std::max<std::size_t>(study.participants().size(), 1)));
    {
        std::vector<std::jthread> others;
        for (unsigned i = 1; i < threads; ++i) others.emplace_back([&] { shared.work(); });
        shared.work();
    }
    return shared.result();
}

}  // namespace burin::activities
