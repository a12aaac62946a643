// SPDX-License-Identifier: MIT
#include "tests/support/places.hpp"

namespace burin {

const char* const kBurinCommand = BURIN_COMMAND;
const char* const kPosingLayer = POSING_LAYER;
const char* const kMeshAudit = MESH_AUDIT;
const char* const kSessionsFolder = BURIN_SOURCES "/assets/sessions";
const char* const kWallsFolder = BURIN_SOURCES "/assets/walls";
const char* const kBenchRecord = BURIN_SOURCES "/bench/record";
const char* const kStudyTests = BURIN_SOURCES "/tests/study";

}  // namespace burin
