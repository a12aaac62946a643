// SPDX-License-Identifier: MIT
#include "base/try.hpp"
#include "record/export/new_file.hpp"
#include "record/export/table_export.hpp"

namespace burin::record {

Result<ExportReport> export_csv(RecordReader& reader, std::size_t table, const std::vector<std::size_t>& columns,
                                const std::string& path, const TickTimes& times) {
    BURIN_TRY(file, NewFile::create(path));
    std::string line;
    const auto add = [&](const std::string& text) { (line += line.empty() ? "" : ",") += text; };
    for (const std::size_t column : columns) add(reader.table(table).columns[column].name);
    BURIN_TRY_DO(file.write(line + "\n"));
    ExportReport report{0, columns.size(), {}};
    const auto done = each_block(reader, table, times, report, [&](const Block& block) -> Result<void> {
        for (std::uint32_t row = 0; row < block.rows(); ++row) {
            line.clear();
            for (const std::size_t column : columns) add(text_of(block.at(column, row), block.type(column)));
            BURIN_TRY_DO(file.write(line + "\n"));
        }
        return {};
    });
    if (!done) return std::unexpected(done.error());
    BURIN_TRY_DO(file.finish());
    return report;
}

}  // namespace burin::record
