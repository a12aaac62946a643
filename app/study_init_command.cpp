// SPDX-License-Identifier: MIT
#include <cstdio>

#include "app/study_command.hpp"
#include "base/file_io.hpp"
#include "study/folder/study_folder.hpp"

namespace burin::app {

Result<void> study_init(const StudyInitOptions& options) {
    const auto text = read_text_file(options.protocol, study::kMostProtocolBytes);
    if (!text) return std::unexpected(text.error());
    const study::ParsedProtocol parsed = study::parse_protocol(*text);
    for (const study::ProtocolFault& f : parsed.faults) std::printf("%s\n", line_of(f, options.protocol).c_str());
    std::fflush(stdout);
    if (!parsed.faults.empty())
        return fail(options.protocol, std::to_string(parsed.faults.size()) + " faults", "correct what is listed");
    if (const auto ok = study::create_study(options.study, *text, options.seed, options.participants); !ok) return ok;
    const auto made = study::StudyFolder::open(options.study, study::StudyAccess::read);
    if (!made) return std::unexpected(made.error());
    std::printf("%s: protocol %s, SHA-256 %s, seed %llu, %u places in each stratum\n", options.study.c_str(),
                made->protocol().name.c_str(), made->facts().protocol_digest.c_str(),
                static_cast<unsigned long long>(options.seed), options.participants);
    return {};
}

}  // namespace burin::app
