// SPDX-License-Identifier: Apache-2.0
// Copyright Contributors to the Regain project

// Trees of closures: weights, what is left out, limits.

#include <regain/shaders/closure_tree.h>

#include <gtest/gtest.h>

#include <functional>
#include <string>

using namespace regain;
using namespace regain::shaders;

namespace {

using Color = Imath::Color3<double>;

PlainMaterial diffuse() { return {OrenNayarSurface{}}; }

Color weights(const ClosureTree& tree, std::vector<Color> albedo, std::vector<Color>& weight)
{
    weight.assign(std::size_t(tree.lobes()), Color(-1.0));
    return tree.lobe_weights(albedo.data(), weight.data());
}

std::string refusal(const std::function<void()>& f)
{
    try
    {
        f();
    }
    catch (const std::invalid_argument& e)
    {
        return e.what();
    }
    return {};
}

TEST(ClosureTree, one_closure_has_the_weight_1)
{
    const ClosureTree tree(diffuse());
    std::vector<Color> w;
    EXPECT_EQ(tree.lobes(), 1);
    EXPECT_EQ(weights(tree, {Color(0.4)}, w), Color(0.4));
    EXPECT_EQ(w[0], Color(1.0));
    EXPECT_STREQ(tree.lobe_name(0), "diffuse");
}

// ((a on b) * 1/2) mixed 1 : 3 with (c + d): by hand.
TEST(ClosureTree, weights_are_the_product_of_those_above)
{
    ClosureTree tree;
    const auto a = tree.lobe(diffuse(), "a"), b = tree.lobe(diffuse(), "b"),
               c = tree.lobe(diffuse(), "c"), d = tree.lobe(diffuse(), "d");
    tree.set_root(
        tree.mix(tree.multiply(tree.layer(a, b), ColorD(0.5, 1.0, 2.0)), tree.add(c, d), 0.25));
    ASSERT_EQ(tree.lobes(), 4);
    EXPECT_STREQ(tree.lobe_name(2), "c");
    std::vector<Color> w;
    const Color E = weights(tree, {Color(0.2, 0.4, 1.5), Color(0.5), Color(0.3), Color(0.1)}, w);
    const double half[] = {0.5, 1.0, 2.0}, top[] = {0.2, 0.4, 1.5}, rest[] = {0.8, 0.6, 0.0};
    for (int k = 0; k < 3; ++k)
    {
        EXPECT_DOUBLE_EQ(w[0][k], 0.25 * half[k]);
        EXPECT_DOUBLE_EQ(w[1][k], 0.25 * half[k] * rest[k]);
        EXPECT_DOUBLE_EQ(w[2][k], 0.75);
        EXPECT_DOUBLE_EQ(w[3][k], 0.75);
        EXPECT_DOUBLE_EQ(E[k], 0.25 * half[k] * (top[k] + rest[k] * 0.5) + 0.75 * 0.4);
    }
}

TEST(ClosureTree, a_layer_of_layers_lets_through_what_both_leave)
{
    ClosureTree tree;
    const auto a = tree.lobe(diffuse()), b = tree.lobe(diffuse()), c = tree.lobe(diffuse());
    std::vector<Color> w;
    for (const bool left : {true, false})
    {
        tree.set_root(left ? tree.layer(tree.layer(a, b), c) : tree.layer(a, tree.layer(b, c)));
        const Color E = weights(tree, {Color(0.2), Color(0.5), Color(1.0)}, w);
        EXPECT_NEAR(w[1].x, 0.8, 1e-15);
        EXPECT_NEAR(w[2].x, 0.8 * 0.5, 1e-15);
        EXPECT_NEAR(E.x, 1, 1e-15);
    }
}

TEST(ClosureTree, what_has_no_weight_is_left_out)
{
    ClosureTree tree;
    const auto a = tree.lobe(diffuse(), "a"), b = tree.lobe(diffuse(), "b");
    const auto lobes = [&](ClosureTree::Node root) {
        tree.set_root(root);
        std::string names;
        for (int k = 0; k < tree.lobes(); ++k) names += tree.lobe_name(k);
        std::vector<Color> w;
        EXPECT_EQ(weights(tree, {Color(0.5), Color(0.5)}, w) == Color(0.0), names.empty());
        return names;
    };
    const auto black = tree.multiply(a, ColorD(0.0));
    EXPECT_EQ(lobes(tree.mix(a, b, 0)), "b");
    EXPECT_EQ(lobes(tree.mix(a, b, 1)), "a");
    EXPECT_EQ(lobes(tree.layer(black, b)), "b");
    EXPECT_EQ(lobes(tree.layer(b, black)), "b");
    EXPECT_EQ(lobes(tree.add(black, b)), "b");
    EXPECT_EQ(lobes(tree.multiply(tree.add(a, b), ColorD(-1.0))), "");
    EXPECT_EQ(lobes(tree.mix(a, b, std::nan(""))), "b");
    EXPECT_EQ(lobes(black), "");
    // Twice in a tree, it is two closures.
    EXPECT_EQ(lobes(tree.add(a, a)), "aa");
}

// A table that nobody needs is not looked for.
TEST(ClosureTree, tables_are_bound_for_what_is_left_in)
{
    MicrofacetMaterial impossible;
    impossible.surface = SheenSurface{};
    impossible.method = Method::turquin;
    ClosureTree tree;
    const auto a = tree.lobe(impossible), b = tree.lobe(diffuse());
    tree.set_root(tree.mix(a, b, 0));
    tree.bind_tables();
    tree.set_root(tree.mix(a, b, 0.5));
    EXPECT_NE(refusal([&] { tree.bind_tables(); }), "");
}

TEST(ClosureTree, closures_can_be_exchanged_and_left_out_later)
{
    ClosureTree tree;
    MicrofacetMaterial metal;
    const auto a = tree.lobe(metal), b = tree.lobe(diffuse());
    const auto root = tree.layer(a, tree.mix(a, b, 0.5));
    tree.set_root(root);
    ASSERT_EQ(tree.lobes(), 3);
    metal.method = Method::none;
    tree.set_material(a, metal);
    // Wherever it is, and where it was asked for.
    for (const int k : {0, 1})
        EXPECT_EQ(name(std::get<MicrofacetMaterial>(tree.material(k)).method), "none");
    EXPECT_EQ(name(std::get<MicrofacetMaterial>(tree.material_of(a)).method), "none");

    tree.leave_out(a);
    ASSERT_EQ(tree.lobes(), 1);
    EXPECT_EQ(tree.node_of(0), b);
    std::vector<Color> w;
    weights(tree, {Color(1.0)}, w);
    EXPECT_EQ(w[0], Color(0.5));
    EXPECT_EQ(tree.root(), root);
    tree.leave_out(b);
    EXPECT_EQ(tree.lobes(), 0);
    for (const auto node : {root, -1, 99})
    {
        EXPECT_NE(refusal([&] { tree.leave_out(node); }).find("is no lobe"), std::string::npos);
        EXPECT_NE(refusal([&] { tree.set_material(node, metal); }).find("is no lobe"),
                  std::string::npos);
    }
}

TEST(ClosureTree, limits_are_told)
{
    ClosureTree tree;
    auto all = tree.lobe(diffuse());
    EXPECT_NE(refusal([&] { tree.set_root(7); }).find("1 nodes has no node 7"), std::string::npos);
    EXPECT_NE(refusal([&] { tree.set_root(-1); }).find("no node -1"), std::string::npos);
    for (int k = 1; k < ClosureTree::most_lobes; ++k) all = tree.add(all, tree.lobe(diffuse()));
    EXPECT_EQ(refusal([&] { tree.set_root(all); }), "");
    EXPECT_EQ(tree.lobes(), ClosureTree::most_lobes);
    all = tree.add(all, tree.lobe(diffuse()));
    EXPECT_NE(refusal([&] { tree.set_root(all); }).find("more than 16 closures"),
              std::string::npos);
    auto deep = tree.lobe(diffuse());
    for (int k = 0; k <= ClosureTree::deepest; ++k) deep = tree.multiply(deep, ColorD(0.9));
    EXPECT_NE(refusal([&] { tree.set_root(deep); }).find("more than 64 deep"), std::string::npos);
}

}  // namespace
