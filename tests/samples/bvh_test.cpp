// The trees of the software ray backend: whole, within their bounds, and as cheap to walk as they should be.
#include <rays/mesh_impl.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

#include <device/internals.h>
#include <gtest/gtest.h>

#include <common/mesh_builder.h>
#include <common/scene.h>

namespace {

using restir::Box;
using restir::BvhGeometry;
using restir::BvhMesh;
using restir::Tree;

// Every box once, inside all boxes above it; parents lead back; no deeper than said.
class Walk {
public:
    Walk(const Tree& tree, std::span<const Box> boxes, uint32_t flags)
        : tree_(tree), boxes_(boxes), flags_(flags) {
        visit(tree.root, tree.box, 0);
        EXPECT_EQ(seen_, boxes.size());
        EXPECT_EQ(deepest_, tree.depth);
        EXPECT_LE(tree.depth, RS_BVH_DEPTH);
    }

private:
    static bool inside(const Box& box, const Box& outer) {
        for (int i = 0; i < 3; ++i)
            if (box.low[i] < outer.low[i] || box.high[i] > outer.high[i]) return false;
        return true;
    }
    void visit(uint32_t word, const Box& outer, uint32_t depth) {
        if (word == RS_BVH_EMPTY) return;
        deepest_ = std::max(deepest_, depth);
        if (word & RS_BVH_LEAF) {
            const uint32_t first = word & RS_BVH_INDEX, count = (word >> RS_BVH_COUNT_SHIFT & 3) + 1;
            EXPECT_EQ(word & RS_BVH_INSTANCE, flags_);
            for (uint32_t i = first; i < first + (flags_ ? 1 : count); ++i)
                EXPECT_TRUE(inside(boxes_[tree_.order[i]], outer));
            seen_ += flags_ ? 1 : count;
            return;
        }
        const restir::gpu::RsBvhNode& n = tree_.nodes[word];
        const Box children[2] = {{{n.low0.x, n.low0.y, n.low0.z}, {n.high0.x, n.high0.y, n.high0.z}},
                                 {{n.low1.x, n.low1.y, n.low1.z}, {n.high1.x, n.high1.y, n.high1.z}}};
        const uint32_t words[2] = {n.child0, n.child1};
        for (uint32_t i = 0; i < 2; ++i) {
            EXPECT_TRUE(inside(children[i], outer));
            if (!(words[i] & RS_BVH_LEAF)) {
                EXPECT_EQ(tree_.nodes[words[i]].parent, 2 * word + i);
            }
            visit(words[i], children[i], depth + 1);
        }
    }

    const Tree& tree_;
    std::span<const Box> boxes_;
    uint32_t flags_;
    size_t seen_ = 0;
    uint32_t deepest_ = 0;
};

std::vector<Box> boxesOf(const samples::SceneData& scene) {
    std::vector<Box> boxes;
    for (const samples::Instance& instance : scene.instances)
        for (const samples::Geometry& g : scene.meshes[instance.mesh].geometries)
            for (size_t i = 0; i < g.indices.size(); i += 3) {
                Box& box = boxes.emplace_back(Box::empty());
                for (size_t c = 0; c < 3; ++c) {
                    const glm::vec3 p =
                        instance.worldFromObject * glm::vec4(g.positions[g.indices[i + c]], 1);
                    box.add(&p.x);
                }
            }
    return boxes;
}

// The best split at any box in any axis, leaves where they cost less: O(n log^2 n), with the same costs.
double sweptCost(std::vector<Box> boxes, double rootArea, uint32_t leafSize) {
    Box all = Box::empty();
    for (const Box& box : boxes) all.add(box);
    const double leaf = double(boxes.size()) * all.area();
    if (boxes.size() == 1) return leaf / rootArea;
    double best = std::numeric_limits<double>::infinity();
    int bestAxis = 0;
    size_t bestAt = boxes.size() / 2;
    const auto sort = [&](int axis) {
        std::sort(boxes.begin(), boxes.end(),
                  [&](const Box& a, const Box& b) { return a.centre(axis) < b.centre(axis); });
    };
    for (int axis = 0; axis < 3; ++axis) {
        sort(axis);
        std::vector<double> right(boxes.size());
        Box box = Box::empty();
        for (size_t i = boxes.size(); i-- > 1;) {
            box.add(boxes[i]);
            right[i] = double(boxes.size() - i) * box.area();
        }
        box = Box::empty();
        for (size_t i = 1; i < boxes.size(); ++i) {
            box.add(boxes[i - 1]);
            const double cost = double(i) * box.area() + right[i];
            if (cost < best) best = cost, bestAxis = axis, bestAt = i;
        }
    }
    if (boxes.size() <= leafSize && all.area() + best >= leaf) return leaf / rootArea;
    sort(bestAxis);
    const std::vector<Box> a(boxes.begin(), boxes.begin() + long(bestAt)),
        b(boxes.begin() + long(bestAt), boxes.end());
    return all.area() / rootArea + sweptCost(a, rootArea, leafSize) + sweptCost(b, rootArea, leafSize);
}

// Halves of the list as it comes, as a builder that does not look makes them.
double halvedCost(std::span<const Box> boxes, double rootArea, uint32_t leafSize) {
    Box all = Box::empty();
    for (const Box& box : boxes) all.add(box);
    if (boxes.size() <= leafSize) return double(boxes.size()) * all.area() / rootArea;
    const size_t half = boxes.size() / 2;
    return all.area() / rootArea + halvedCost(boxes.first(half), rootArea, leafSize) +
           halvedCost(boxes.subspan(half), rootArea, leafSize);
}

TEST(Bvh, CostsLittleMoreThanTheBestOfAllSplits) {
    for (const char* name : {"cornell", "street?triangles=6000&emissive=300", "market"}) {
        std::vector<Box> boxes = boxesOf(samples::makeBuiltin(name));
        if (boxes.size() > 20000) boxes.resize(20000);
        Tree tree;
        restir::buildTree(boxes, RS_BVH_LEAF_TRIANGLES, 0, tree);
        const Walk walk(tree, boxes, 0);
        const double swept = sweptCost(boxes, tree.box.area(), RS_BVH_LEAF_TRIANGLES),
                     halved = halvedCost(boxes, tree.box.area(), RS_BVH_LEAF_TRIANGLES);
        std::printf("%-36s %6zu boxes: cost %.2f, of a full sweep %.2f, of halves in order %.2f, depth %u\n",
                    name, boxes.size(), tree.cost, swept, halved, tree.depth);
        EXPECT_LE(tree.cost, 1.05 * swept) << name;
        EXPECT_LE(tree.cost, 0.9 * halved) << name;
    }
}

TEST(Bvh, CostIsThatOfItsNodes) {
    const std::vector<Box> two = {{{0, 0, 0}, {1, 1, 1}}, {{9, 0, 0}, {10, 1, 1}}};   // areas 3 and 3, of 21
    Tree tree;
    restir::buildTree(two, 1, RS_BVH_INSTANCE, tree);
    EXPECT_EQ(tree.nodes.size(), 1u);
    EXPECT_NEAR(tree.cost, 1 + 6.0 / 21, 1e-12);
}

// What splits badly: boxes in a row that doubles, all in one place, huge and tiny ones.
TEST(Bvh, IsNoDeeperThanItsTrail) {
    std::vector<std::vector<Box>> hard(4);
    for (int i = 0; i < 4000; ++i) {
        const float x = std::ldexp(1.0f, i % 116 - 58), y = std::ldexp(1.0f, i / 40 - 50);
        hard[0].push_back({{x, 0, 0}, {1.001f * x, 1e-9f, 1e-9f}});
        hard[1].push_back({{1, 2, 3}, {1, 2, 3}});
        hard[2].push_back({{-x, -y, -x}, {x, y, y}});
        hard[3].push_back({{x, y, 0}, {1.5f * x, 1.5f * y, 0}});
    }
    for (const std::vector<Box>& boxes : hard) {
        for (uint32_t leafSize : {1u, RS_BVH_LEAF_TRIANGLES}) {
            Tree tree;
            restir::buildTree(boxes, leafSize, leafSize == 1 ? RS_BVH_INSTANCE : 0, tree);
            const Walk walk(tree, boxes, leafSize == 1 ? RS_BVH_INSTANCE : 0);
        }
    }
}

TEST(Bvh, NothingAndOne) {
    Tree tree;
    restir::buildTree({}, 4, 0, tree);
    EXPECT_EQ(tree.root, RS_BVH_EMPTY);
    EXPECT_EQ(tree.nodes.size(), 0u);
    const Box one{{0, 0, 0}, {1, 0, 1}};
    restir::buildTree({&one, 1}, 4, 0, tree);
    EXPECT_EQ(tree.root, RS_BVH_LEAF);
    EXPECT_EQ(tree.nodes.size(), 0u);
}

TEST(BvhMesh, IgnoresWhatCannotBeHit) {
    constexpr float nan = std::numeric_limits<float>::quiet_NaN(),
                    inf = std::numeric_limits<float>::infinity();
    const std::vector<float> positions = {0, 0,   0, 1, 0,     0, 0, 1, 0, nan, 0,
                                          0, inf, 0, 0, 2e18f, 0, 0, 2, 0, 0};
    const std::vector<uint32_t> indices = {0, 1, 2, 0, 1, 3, 0, 1, 4, 5, 1, 2, 0, 1, 6, 0, 0, 0, 2, 1, 0};
    const BvhGeometry geometry{.positions = positions, .indices = indices};
    const auto mesh = BvhMesh::create({.geometries = {&geometry, 1}});
    ASSERT_TRUE(mesh);
    EXPECT_EQ(mesh->statistics().triangles, 2u);
    EXPECT_EQ(mesh->statistics().ignored, 5u);
    const auto& corners = restir::Internals::of(*mesh).corners;
    EXPECT_EQ(corners[0][0].id + corners[0][1].id, 0u + 6u);   // primitives keep their numbers
}

TEST(BvhMesh, RefusesByName) {
    std::string said;
    const restir::MessageSink sink{&said, [](void* user, restir::Severity, const char* text) {
                                       *static_cast<std::string*>(user) = text;
                                   }};
    const std::vector<float> positions(9);
    const std::vector<uint32_t> beyond = {0, 1, 2, 0, 3, 1}, odd = {0, 1};
    for (const auto& [indices, words] :
         {std::pair(&beyond, "is 3 at triangle 1, there are 3 vertices"), std::pair(&odd, "has 2 indices")}) {
        const BvhGeometry geometries[] = {{}, {.positions = positions, .indices = *indices}};
        const auto mesh = BvhMesh::create({.geometries = geometries, .messages = sink});
        ASSERT_FALSE(mesh);
        EXPECT_EQ(mesh.error().status, restir::Status::InvalidArgument);
        EXPECT_NE(said.find("BvhGeometry::indices of geometry 1"), std::string::npos) << said;
        EXPECT_NE(said.find(words), std::string::npos) << said;
    }
}

}   // namespace
