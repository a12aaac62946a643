// SPDX-License-Identifier: MIT
// The main of every test program. A test that broke a contract on the way fails, even if its own assertions held.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "base/error.hpp"
#include "tests/support/property_cases.hpp"

namespace {
class ContractListener : public testing::EmptyTestEventListener {
    void OnTestStart(const testing::TestInfo&) override { before_ = burin::broken_contracts(); }
    void OnTestEnd(const testing::TestInfo&) override {
        EXPECT_EQ(burin::broken_contracts(), before_) << "a BURIN_CHECK failed during this test";
    }
    std::uint64_t before_ = 0;
};

// A folder of the test's own for what programs keep of their users (journals), so that no run depends on another's.
class StateFolder {
public:
    StateFolder() {
        std::string name = (std::filesystem::temp_directory_path() / "burin-test-state-XXXXXX").string();
        if (mkdtemp(name.data()) == nullptr) return;
        path_ = name;
        setenv("XDG_STATE_HOME", name.c_str(), 1);
    }
    ~StateFolder() {
        std::error_code ignored;
        if (!path_.empty()) std::filesystem::remove_all(path_, ignored);
    }
    StateFolder(const StateFolder&) = delete;
    StateFolder& operator=(const StateFolder&) = delete;

private:
    std::filesystem::path path_;
};
// Leaves out the cases that this build has no use for (STEPPED in cmake/BurinTargets.cmake), unless the user chooses
// cases, with a filter of GoogleTest.
void leave_out_useless_cases() {
    const char* cases = std::getenv("BURIN_TEST_LEAVES_OUT");
    if (cases != nullptr && GTEST_FLAG_GET(filter) == "*") GTEST_FLAG_SET(filter, "-" + std::string(cases));
}

}  // namespace

int main(int argc, char** argv) {
    testing::InitGoogleTest(&argc, argv);
    leave_out_useless_cases();
    burin::test::set_up_properties();
    const StateFolder state;
    testing::UnitTest::GetInstance()->listeners().Append(new ContractListener);
    return RUN_ALL_TESTS();
}
