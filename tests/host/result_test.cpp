#include <restir/result.h>

#include <memory>
#include <type_traits>

#include <gtest/gtest.h>

namespace {

using restir::Error;
using restir::Result;
using restir::Status;

TEST(Result, HoldsAMoveOnlyValue) {
    Result<std::unique_ptr<int>> result = std::make_unique<int>(7);
    ASSERT_TRUE(static_cast<bool>(result));
    EXPECT_EQ(**result, 7);
    const std::unique_ptr<int> taken = *std::move(result);
    EXPECT_EQ(*taken, 7);
}

TEST(Result, HoldsAnError) {
    const Result<int> result = Error{Status::DeviceError, VK_ERROR_DEVICE_LOST, "lost"};
    ASSERT_FALSE(static_cast<bool>(result));
    EXPECT_EQ(result.error().status, Status::DeviceError);
    EXPECT_EQ(result.error().vk, VK_ERROR_DEVICE_LOST);
    EXPECT_STREQ(result.error().what, "lost");
}

TEST(Result, ReachesMembersOfItsValue) {
    struct Pair {
        int a, b;
    };
    Result<Pair> result = Pair{1, 2};
    result->b = 5;
    EXPECT_EQ((*result).a + (*result).b, 6);
}

TEST(Result, AFailureIsNotTakenForAValue) {
    static_assert(!std::is_convertible_v<Result<int>, bool>);
    static_assert(!std::is_convertible_v<Status, bool>);
    EXPECT_EQ(Error{}.status, Status::Ok);
}

}   // namespace
