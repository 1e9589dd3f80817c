// The last word of every run of this program: validation had nothing to say.
#include <gtest/gtest.h>

#include "image/world.h"

namespace tests {
namespace {

class NoMessages : public testing::Environment {
public:
    void TearDown() override { EXPECT_EQ(device().validationMessages(), 0u); }
};

const testing::Environment* const kNoMessages = testing::AddGlobalTestEnvironment(new NoMessages);

}   // namespace
}   // namespace tests
