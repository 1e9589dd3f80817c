#include <rays/tree.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace restir {
namespace {

constexpr uint32_t kBins = 16;
constexpr double kNodeCost = 1;   // of testing two boxes, in tests of a triangle

struct Bin {
    Box box = Box::empty();
    uint32_t count = 0;
};

// A range of the order that becomes a child, and where its word goes.
struct Task {
    uint32_t first, last;   // one behind
    Box box, centres;
    uint32_t entry;   // of the tree's nodes; kRoot: the root
    uint32_t depth;   // nodes above
};
constexpr uint32_t kRoot = ~0u;

struct Split {
    double cost = std::numeric_limits<double>::infinity();
    int axis = -1;   // none found
    uint32_t bin = 0;
};

// A box and its place among those given. Ranges are sorted themselves, not places in them: what a node sweeps
// over is then contiguous.
struct Item {
    Box box;
    uint32_t index;
};

class Builder {
public:
    Builder(std::span<const Box> boxes, uint32_t leafSize, uint32_t leafFlags, Tree& tree)
        : leafSize_(leafSize), leafFlags_(leafFlags), tree_(tree) {
        items_.reserve(boxes.size());
        for (const Box& box : boxes) items_.push_back({box, uint32_t(items_.size())});
    }

    void run() {
        const auto count = uint32_t(items_.size());
        tree_.nodes.clear();
        tree_.order.clear();
        tree_.root = RS_BVH_EMPTY;
        tree_.depth = 0;
        tree_.cost = 0;
        Task all = taskOf(0, count, kRoot, 0);
        tree_.box = all.box;
        if (count == 0) return;
        rootArea_ = std::max(all.box.area(), 1e-300);
        todo_.push_back(all);
        while (!todo_.empty()) {
            const Task task = todo_.back();
            todo_.pop_back();
            build(task);
        }
        tree_.order.reserve(count);
        for (const Item& item : items_) tree_.order.push_back(item.index);
    }

private:
    Task taskOf(uint32_t first, uint32_t last, uint32_t entry, uint32_t depth) const noexcept {
        Task task{first, last, Box::empty(), Box::empty(), entry, depth};
        for (uint32_t i = first; i < last; ++i) {
            const Box& box = items_[i].box;
            const float centre[3] = {box.centre(0), box.centre(1), box.centre(2)};
            task.box.add(box);
            task.centres.add(centre);
        }
        return task;
    }

    void setWord(const Task& task, uint32_t word) noexcept {
        if (task.entry == kRoot)
            tree_.root = word;
        else
            (task.entry % 2 == 0 ? tree_.nodes[task.entry / 2].child0 : tree_.nodes[task.entry / 2].child1) =
                word;
    }

    void makeLeaf(const Task& task) noexcept {
        const uint32_t count = task.last - task.first;
        tree_.cost += count * task.box.area() / rootArea_;
        setWord(task, RS_BVH_LEAF | leafFlags_ | (count - 1) << RS_BVH_COUNT_SHIFT | task.first);
    }

    void build(const Task& task) {
        const uint32_t count = task.last - task.first;
        if (count == 1) return makeLeaf(task);
        const Split split = findSplit(task);
        if (count <= leafSize_ && !(kNodeCost * task.box.area() + split.cost < count * task.box.area()))
            return makeLeaf(task);
        const uint32_t middle = divide(task, split);
        const auto node = uint32_t(tree_.nodes.size());
        setWord(task, node);
        tree_.nodes.push_back({});
        tree_.nodes[node].parent = task.entry;
        tree_.depth = std::max(tree_.depth, task.depth + 1);
        tree_.cost += kNodeCost * task.box.area() / rootArea_;
        const Task children[2] = {taskOf(task.first, middle, 2 * node, task.depth + 1),
                                  taskOf(middle, task.last, 2 * node + 1, task.depth + 1)};
        setBoxes(tree_.nodes[node], children[0].box, children[1].box);
        todo_.push_back(children[1]);   // the first child comes next in memory
        todo_.push_back(children[0]);
    }

    static void setBoxes(gpu::RsBvhNode& node, const Box& a, const Box& b) noexcept {
        node.low0 = {a.low[0], a.low[1], a.low[2]};
        node.high0 = {a.high[0], a.high[1], a.high[2]};
        node.low1 = {b.low[0], b.low[1], b.low[2]};
        node.high1 = {b.high[0], b.high[1], b.high[2]};
    }

    // Whether halves are all that the rest of the depth has room for.
    bool mustHalve(const Task& task) const noexcept {
        const uint32_t leaves = (task.last - task.first + leafSize_ - 1) / leafSize_;
        return task.depth + uint32_t(std::bit_width(leaves)) + 1 >= RS_BVH_DEPTH;
    }

    static uint32_t binOf(const Task& task, int axis, float scale, const Box& box) noexcept {
        return std::min(uint32_t((box.centre(axis) - task.centres.low[axis]) * scale), kBins - 1);
    }
    static float binScale(const Task& task, int axis) noexcept {
        const float width = task.centres.high[axis] - task.centres.low[axis];
        const float scale = float(kBins) / width;
        return width > 0 && std::isfinite(scale) ? scale : 0;
    }

    Split findSplit(const Task& task) noexcept {
        Split best;
        if (mustHalve(task)) return best;
        Bin bins[3][kBins];
        const float scale[3] = {binScale(task, 0), binScale(task, 1), binScale(task, 2)};
        for (uint32_t i = task.first; i < task.last; ++i) {
            const Box& box = items_[i].box;
            for (int axis = 0; axis < 3; ++axis) {
                Bin& bin = bins[axis][binOf(task, axis, scale[axis], box)];
                bin.box.add(box);
                ++bin.count;
            }
        }
        for (int axis = 0; axis < 3; ++axis)
            if (scale[axis] > 0) sweep(bins[axis], axis, best);
        return best;
    }

    static void sweep(const Bin (&bins)[kBins], int axis, Split& best) noexcept {
        double right[kBins];   // cost of the bins from i on
        Box box = Box::empty();
        uint32_t count = 0;
        for (uint32_t i = kBins - 1; i > 0; --i) {
            box.add(bins[i].box);
            count += bins[i].count;
            right[i] = count > 0 ? count * box.area() : std::numeric_limits<double>::infinity();
        }
        box = Box::empty();
        count = 0;
        for (uint32_t i = 1; i < kBins; ++i) {
            box.add(bins[i - 1].box);
            count += bins[i - 1].count;
            if (count == 0) continue;
            const double cost = count * box.area() + right[i];
            if (cost < best.cost) best = {cost, axis, i};
        }
    }

    // Reorders the range; where its second part begins.
    uint32_t divide(const Task& task, const Split& split) noexcept {
        const auto begin = items_.begin() + task.first, end = items_.begin() + task.last;
        if (split.axis >= 0) {
            const float scale = binScale(task, split.axis);
            const auto left = [&](const Item& item) {
                return binOf(task, split.axis, scale, item.box) < split.bin;
            };
            return uint32_t(std::partition(begin, end, left) - items_.begin());
        }
        int axis = 0;
        for (int i = 1; i < 3; ++i)
            if (task.centres.high[i] - task.centres.low[i] > task.centres.high[axis] - task.centres.low[axis])
                axis = i;
        const auto middle = begin + (task.last - task.first) / 2;
        std::nth_element(begin, middle, end, [&](const Item& a, const Item& b) {
            return a.box.centre(axis) < b.box.centre(axis);
        });
        return uint32_t(middle - items_.begin());
    }

    std::vector<Item> items_;
    uint32_t leafSize_, leafFlags_;
    Tree& tree_;
    double rootArea_ = 1;
    std::vector<Task> todo_;
};

}   // namespace

Box Box::empty() noexcept {
    constexpr float kMost = std::numeric_limits<float>::max();
    return {{kMost, kMost, kMost}, {-kMost, -kMost, -kMost}};
}

void Box::add(const Box& other) noexcept {
    for (int i = 0; i < 3; ++i) {
        low[i] = std::min(low[i], other.low[i]);
        high[i] = std::max(high[i], other.high[i]);
    }
}

void Box::add(const float* point) noexcept {
    for (int i = 0; i < 3; ++i) {
        low[i] = std::min(low[i], point[i]);
        high[i] = std::max(high[i], point[i]);
    }
}

double Box::area() const noexcept {
    if (isEmpty()) return 0;
    const double x = double(high[0]) - low[0], y = double(high[1]) - low[1], z = double(high[2]) - low[2];
    return x * y + y * z + z * x;
}

void buildTree(std::span<const Box> boxes, uint32_t leafSize, uint32_t leafFlags, Tree& tree) {
    Builder(boxes, leafSize, leafFlags, tree).run();
}

}   // namespace restir
