// SPDX-License-Identifier: MIT
// Where the programs that a test starts lie, and what they read. Absolute, since tests start them in folders of their
// own. Told by one source: in the options of all tests they would differ in every clone, and no compiler's cache would
// know any of these again.
#pragma once

namespace burin {

extern const char* const kBurinCommand;    // the program burin
extern const char* const kPosingLayer;     // the folder of tests/tools/vulkan_layer as it is built
extern const char* const kMeshAudit;       // the judge of meshes, tests/tools
extern const char* const kSessionsFolder;  // assets/sessions
extern const char* const kWallsFolder;     // assets/walls
extern const char* const kBenchRecord;     // the script bench/record
extern const char* const kStudyTests;      // tests/study, with scripts of SciPy and R

}  // namespace burin
