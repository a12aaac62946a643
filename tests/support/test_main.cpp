// SPDX-License-Identifier: MIT
// The main of every test program. A test that broke a contract on the way fails, even if its own assertions held.
#include <gtest/gtest.h>

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
}  // namespace

int main(int argc, char** argv) {
    testing::InitGoogleTest(&argc, argv);
    burin::test::set_up_properties();
    testing::UnitTest::GetInstance()->listeners().Append(new ContractListener);
    return RUN_ALL_TESTS();
}
