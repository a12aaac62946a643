// SPDX-License-Identifier: MIT
#include <cstdio>
#include <memory>

#include "app/study/study_command.hpp"
#include "app/study/study_reach.hpp"
#include "base/file_io.hpp"
#include "base/try.hpp"
#include "study/folder/study_folder.hpp"

namespace burin::app {
namespace {

// A file, or the name of a protocol that comes with the program.
Result<std::string> protocol_named(const std::string& protocol) {
    std::error_code ignored;
    const auto known = study::known_protocol(protocol);
    if (known && !std::filesystem::exists(protocol, ignored)) return std::string(*known);
    return read_text_file(protocol, study::kMostProtocolBytes);
}

// Says where the list may end within a block, so that the groups are not of the protocol's ratios.
void warn_of_blocks(const study::Protocol& protocol, unsigned places) {
    const auto& blocks = protocol.blocks;
    if (blocks.size() == 1 && places % blocks.front() == 0) return;
    std::string sizes;
    for (const unsigned size : blocks) sizes += (sizes.empty() ? "" : " or ") + std::to_string(size);
    std::printf(
        "Note: blocks are of %s places, and a list of %u %s within one: the last block is then cut off, and the "
        "groups may be unequal.\n",
        sizes.c_str(), places, blocks.size() == 1 ? "ends" : "may end");
}

}  // namespace

Result<void> study_init(const StudyInitOptions& options) {
    const bool by_place = options.protocol.empty();
    if (options.places.size() != (by_place ? 2u : 1u))
        return fail("burin study init", "needs a protocol and a new folder",
                    "write: burin study init PROTOCOL STUDY; PROTOCOL is a file, or kinesthetic-path");
    const std::string protocol = by_place ? options.places.front() : options.protocol;
    const std::string folder = options.places.back();
    BURIN_TRY(text, protocol_named(protocol));
    const study::ParsedProtocol parsed = study::parse_protocol(text);
    for (const study::ProtocolFault& f : parsed.faults) std::printf("%s\n", line_of(f, protocol).c_str());
    std::fflush(stdout);
    if (!parsed.faults.empty())
        return fail(protocol, std::to_string(parsed.faults.size()) + (parsed.faults.size() == 1 ? " fault" : " faults"),
                    "correct what is listed");
    BURIN_TRY_DO(check_reach(parsed.protocol, protocol));
    study::StudyMaking making;
    making.participants = options.participants;
    making.key = options.key;
    if (options.seed) making.seed = *options.seed;
    BURIN_TRY_DO(study::create_study(folder, text, making));
    BURIN_TRY(made, study::StudyFolder::open(folder, study::StudyAccess::read));
    std::printf("%s: protocol %s, SHA-256 %s, %u places in each stratum\n", folder.c_str(),
                made.protocol().name.c_str(), made.facts().protocol_digest.c_str(), options.participants);
    warn_of_blocks(made.protocol(), options.participants);
    if (options.seed)
        std::printf("The allocation is drawn with seed %llu: whoever knows the seed can know the list.\n",
                    static_cast<unsigned long long>(*options.seed));
    else
        std::printf("The allocation is drawn at random and sealed.\n");
    std::printf("Its key is %s.\n", options.key.empty() ? (folder + "/allocation.key").c_str() : options.key.c_str());
    return {};
}

namespace {

CommandAction add_study_init(Command command) {
    const auto options = std::make_shared<StudyInitOptions>();
    command
        .option("PLACES", options->places,
                "PROTOCOL STUDY: a TOML file (docs/study.md) or kinesthetic-path; a new folder")
        .required();
    command.option("--protocol", options->protocol, "The protocol, where only STUDY is named before");
    command.option("--participants", options->participants, "Places of each stratum's list")
        .within(std::uint64_t{1}, std::uint64_t{10'000})
        .show_default();
    command.option("--seed", options->seed, "Of the allocation and of simulated learners; with people leave it out");
    command.option("--key", options->key,
                   "A new file for the key of the sealed allocation, to be kept by who does not enrol");
    return action([options] { return study_init(*options); });
}

}  // namespace

CommandRow study_init_row() {
    return {"init", "Makes a study's folder of a protocol: frozen, with its allocation", add_study_init};
}

}  // namespace burin::app
