// SPDX-License-Identifier: MIT
#include "activities/wand/wand_facts.hpp"

#include <cstddef>
#include <filesystem>
#include <system_error>

#include "base/file_io.hpp"
#include "base/sha256.hpp"
#include "devices/registry/device_registry.hpp"
#include "record/motion.hpp"

namespace burin::activities {

std::string wand_file_of(const std::string& device) { return devices::handle_file_of(device); }

std::vector<std::pair<std::string, std::string>> facts_of_wand_file(const std::string& device) {
    const std::string file = wand_file_of(device);
    if (file.empty()) return {};
    const Result<std::vector<std::byte>> bytes = read_file(file);
    if (!bytes) return {};
    const std::string text(reinterpret_cast<const char*>(bytes->data()), bytes->size());
    return {{record::kWandDigestFact, sha256(text)}, {record::kWandTextFact, text}};
}

Result<void> check_wand_file(const record::RecordReader& reader, const std::string& device, const std::string& remedy) {
    const std::string file = wand_file_of(device), recorded = reader.fact(record::kWandDigestFact);
    if (file.empty() || recorded.empty()) return {};
    std::error_code ignored;
    if (!std::filesystem::exists(file, ignored))
        return fail(file, "is the description of the recording's wand, and is not there", remedy);
    const Result<std::string> now = file_digest(file);
    if (!now) return fail(now.error().where, now.error().what, remedy);
    if (*now == recorded) return {};
    return fail(file, "is another wand than the one that was recorded: SHA-256 " + *now + ", recorded: " + recorded,
                remedy);
}

}  // namespace burin::activities
