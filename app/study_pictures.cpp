// SPDX-License-Identifier: MIT
#include "app/study_pictures.hpp"

#include <cstdio>
#include <map>

#include "activities/train/stage_view.hpp"
#include "base/text.hpp"
#include "gpu/device.hpp"
#include "renderer/frame/renderer.hpp"
#include "renderer/png.hpp"
#include "session/picture/pictures.hpp"
#include "study/replay/stage_replay.hpp"

namespace burin::app {
namespace {

constexpr ImageSize kStagePicture{1280, 800};
constexpr std::uint64_t kLookEvery = 20;  // ticks

// Moments of one stage, fewer the longer it lasts.
struct StageMoments {
    std::vector<activities::StageMoment> all;
    std::vector<bool> running;  // the attempt's clock ran

    // The middle one of those that tell most: within an attempt, and where the wall is touched.
    [[nodiscard]] const activities::StageMoment* chosen() const {
        for (const bool touching : {true, false}) {
            for (const bool attempt : {true, false}) {
                std::vector<std::size_t> fit;
                for (std::size_t i = 0; i < all.size(); ++i)
                    if ((!attempt || running[i]) && (!touching || all[i].touches_wall)) fit.push_back(i);
                if (!fit.empty()) return &all[fit[fit.size() / 2]];
            }
        }
        return nullptr;
    }
};

Result<StageMoments> moments_of(const study::StudyFolder& study, const study::StageVisit& visit,
                                const study::FeltWorld& world) {
    StageMoments moments;
    std::uint64_t ticks = 0;
    const auto replayed =
        study::replay_stage(study.path() / visit.recording, study.protocol(), study.facts().protocol_digest, world,
                            [&](const study::StageSession& session, const haptics::TickRecord& record) {
                                if (ticks++ % kLookEvery != 0) return;
                                moments.all.push_back(activities::moment_of(world, session, record));
                                moments.running.push_back(session.state().phase == study::StagePhase::running);
                            });
    if (!replayed) return std::unexpected(replayed.error());
    return moments;
}

// The first visit of the group to a stage whose motion is there.
const study::StageVisit* first_visit(const std::vector<study::Participant>& people, const std::string& group,
                                     const study::StagePlace& at) {
    for (const study::Participant& p : people) {
        if (p.group != group || p.erased) continue;
        for (const study::StageVisit& v : p.visits) {
            if (v.day == at.day && v.place == at.place && v.status == study::StageStatus::ended && !v.recording.empty())
                return &v;
        }
    }
    return nullptr;
}

}  // namespace

Result<void> draw_stages(const study::StudyFolder& study) {
    const std::filesystem::path folder = study.path() / "pictures";
    if (const auto made = session::make_picture_folder(folder, "--pictures"); !made) return made;
    auto device = gpu::Device::create();
    if (!device) return fail("--pictures", device.error().what, device.error().remedy);
    auto renderer = renderer::Renderer::create(*device, kStagePicture);
    if (!renderer) return std::unexpected(renderer.error());
    const std::vector<study::Participant> people = study.participants();
    std::map<std::string, std::unique_ptr<const study::FeltWorld>> worlds;
    for (const study::Group& group : study.protocol().groups) {
        for (const study::StagePlace& at : study::places_of(study.protocol())) {
            const study::StageVisit* visit = first_visit(people, group.code, at);
            const study::StudyWorld* world = study.protocol().world(at.stage->world);
            if (visit == nullptr || world == nullptr) continue;
            auto& felt = worlds[world->name];
            if (!felt) {
                auto made = study::FeltWorld::create(*world);
                if (!made) return std::unexpected(made.error());
                felt = std::move(*made);
            }
            const auto moments = moments_of(study, *visit, *felt);
            if (!moments) return std::unexpected(moments.error());
            const activities::StageMoment* moment = moments->chosen();
            if (moment == nullptr) continue;
            activities::StageView view(*felt, study.protocol(), *at.stage, group);
            const auto image = renderer->render(view.scene(*moment));
            if (!image) return std::unexpected(image.error());
            const std::string name =
                formatted("%s-day%zu-%02zu-%s.png", group.code.c_str(), at.day, at.place, at.stage->name.c_str());
            if (const auto ok = renderer::write_png(folder / name, image->left); !ok) return ok;
            std::printf("wrote %s\n", (folder / name).c_str());
        }
    }
    return {};
}

}  // namespace burin::app
