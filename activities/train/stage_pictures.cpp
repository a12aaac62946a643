// SPDX-License-Identifier: MIT
#include "activities/train/stage_pictures.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <memory>
#include <sstream>

#include "activities/train/stage_view.hpp"
#include "base/plot/svg.hpp"
#include "base/text.hpp"
#include "base/try.hpp"
#include "study/felt/felt_world.hpp"
#include "study/felt/stage_session.hpp"
#include "study/replay/stage_replay.hpp"

namespace burin::activities {
namespace {

constexpr std::uint64_t kLookEvery = 20;  // ticks

// Moments of one stage, fewer the longer it lasts.
struct StageMoments {
    std::vector<StageMoment> all;
    std::vector<bool> running;  // the attempt's clock ran

    // Returns a moment within an attempt, with the wall touched if there is one, at which the wand is farthest from
    // both ends of the path: their funnels would hide it. Of a wand that rests it is the middle one.
    [[nodiscard]] const StageMoment* chosen(const std::vector<Vec3>& spine_m) const {
        for (const bool touching : {true, false}) {
            for (const bool attempt : {true, false}) {
                std::vector<const StageMoment*> fit;
                for (std::size_t i = 0; i < all.size(); ++i)
                    if ((!attempt || running[i]) && (!touching || all[i].touches_wall)) fit.push_back(&all[i]);
                if (!fit.empty()) return clearest_of(fit, spine_m);
            }
        }
        return nullptr;
    }

    static const StageMoment* clearest_of(const std::vector<const StageMoment*>& fit,
                                          const std::vector<Vec3>& spine_m) {
        constexpr double kRests_m = 0.01;
        const auto away_m = [&](const StageMoment* moment) { return from_ends_m(*moment, spine_m); };
        const auto [least, most] = std::ranges::minmax_element(fit, {}, away_m);
        return away_m(*most) - away_m(*least) < kRests_m ? fit[fit.size() / 2] : *most;
    }

    static double from_ends_m(const StageMoment& moment, const std::vector<Vec3>& spine_m) {
        const Vec3 middle_m = 0.5 * (moment.points_m[0] + moment.points_m[1]);
        return std::min(glm::distance(middle_m, spine_m.front()), glm::distance(middle_m, spine_m.back()));
    }
};

Result<StageMoments> moments_of(const study::StudyFolder& study, const study::StageVisit& visit,
                                const study::FeltWorld& world) {
    StageMoments moments;
    std::uint64_t ticks = 0;
    BURIN_TRY_DO(study::replay_stage(study.path() / visit.recording, study.protocol(), study.facts().protocol_digest,
                                     world, [&](const study::StageSession& session, const haptics::TickRecord& record) {
                                         if (ticks++ % kLookEvery != 0) return;
                                         moments.all.push_back(moment_of(world, session, touches_wall(record)));
                                         moments.running.push_back(session.state().phase == study::StagePhase::running);
                                     }));
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

// A page as its reader sees it: the text in lines no longer than can be read at ease.
std::string page_picture(const std::string& text) {
    constexpr std::size_t kLineLetters = 62;
    constexpr double kLine_px = 34.0;
    std::vector<std::string> lines(1);
    std::istringstream words(text);
    for (std::string word; words >> word;) {
        if (!lines.back().empty() && lines.back().size() + 1 + word.size() > kLineLetters) lines.emplace_back();
        lines.back() += (lines.back().empty() ? "" : " ") + word;
    }
    std::string svg = formatted(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%u\" height=\"%u\" font-size=\"24\" "
        "font-family=\"DejaVu Sans, Arial, sans-serif\">\n<rect width=\"100%%\" height=\"100%%\" fill=\"#ffffff\"/>\n",
        kStagePicture.width, kStagePicture.height);
    double y = 0.5 * (kStagePicture.height - kLine_px * (static_cast<double>(lines.size()) - 1.0));
    for (const std::string& line : lines) {
        svg += plot::write(0.5 * kStagePicture.width, y, "text-anchor=\"middle\"", line);
        y += kLine_px;
    }
    return svg + "</svg>\n";
}

}  // namespace

std::vector<PagePicture> page_pictures(const study::Protocol& protocol) {
    std::vector<PagePicture> pages;
    for (const study::StagePlace& at : study::places_of(protocol)) {
        if (at.stage->kind != study::StageKind::page) continue;
        pages.push_back({formatted("day%zu-%02zu-%s.svg", at.day, at.place, at.stage->name.c_str()),
                         page_picture(at.stage->page_text)});
    }
    return pages;
}

Result<void> draw_stages(const study::StudyFolder& study, const StageDrawer& draw) {
    const std::vector<study::Participant> people = study.participants();
    std::map<std::string, std::unique_ptr<const study::FeltWorld>> worlds;
    for (const study::Group& group : study.protocol().groups) {
        for (const study::StagePlace& at : study::places_of(study.protocol())) {
            const study::StageVisit* visit = first_visit(people, group.code, at);
            const study::StudyWorld* world = study.protocol().world(at.stage->world);
            if (visit == nullptr || world == nullptr) continue;
            auto& felt = worlds[world->name];
            if (!felt) {
                BURIN_TRY(made, study::FeltWorld::create(*world));
                felt = std::move(made);
            }
            BURIN_TRY(moments, moments_of(study, *visit, *felt));
            const StageMoment* moment = moments.chosen(world->spine_m);
            if (moment == nullptr) continue;
            StageView view(*felt, study.protocol(), *at.stage, group);
            const std::string name =
                formatted("%s-day%zu-%02zu-%s.png", group.code.c_str(), at.day, at.place, at.stage->name.c_str());
            BURIN_TRY_DO(draw(view.scene(*moment), name));
        }
    }
    return {};
}

}  // namespace burin::activities
