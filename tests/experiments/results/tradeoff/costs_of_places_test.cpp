// Estimated times of one study for the errors of another: means by kind of place, of made-up tables.
#include "experiments/results/tradeoff/costs_of_places.h"

#include "tests/error_message.h"

#include <gtest/gtest.h>

namespace {

using nlohmann::json;

struct MadeCosts {
    StudyResults tables;

    MadeCosts() {
        tables.manifest["shots"] = json::array();
        tables.manifest["techniques"] = {{{"technique", "v"}, {"point", "a"}, {"parameters", {{"rays", 1}}}}};
    }
    void add_shot(const std::string& shot, const std::string& group) {
        tables.manifest["shots"].push_back(
            {{"shot", shot}, {"scene", shot}, {"group", group}, {"width", 1920}, {"height", 1080}});
    }
    void add(const std::string& shot, const std::string& group, std::optional<double> microseconds) {
        add_shot(shot, group);
        EstimateRow row;
        row.shot = shot, row.technique = "v", row.point = "a", row.stage = "total", row.chip = "navi21";
        row.microseconds = microseconds;
        if (!microseconds) row.refusal = "spills";
        tables.estimates.push_back(row);
    }
};

const EstimateRow& only_of(const StudyResults& tables, const std::string& shot) {
    const auto is_of = [&](const EstimateRow& e) { return e.shot == shot; };
    EXPECT_EQ(std::ranges::count_if(tables.estimates, is_of), 1);
    return *std::ranges::find_if(tables.estimates, is_of);
}

/// Errors in a room at rest, a room in motion and a street; costs in four rooms and one street.
struct BothStudies {
    MadeCosts errors, costs;
    BothStudies() {
        errors.add_shot("still", "rooms, at rest");
        errors.add("moving", "rooms, in motion", 7);
        errors.add_shot("street", "streets, at rest");
        for (const double cost : {100, 110, 120, 130}) costs.add("r" + std::to_string(int(cost)), "rooms", cost);
        costs.add("s", "streets", 50);
    }
};

}  // namespace

TEST(CostsOfPlaces, AShotTakesTheMeanOfItsKind) {
    BothStudies made;
    const std::vector<CostsOfKind> kinds = take_costs_from(made.costs.tables, "navi21", made.errors.tables);
    for (const char* shot : {"still", "moving"}) {
        const EstimateRow& mean = only_of(made.errors.tables, shot);
        EXPECT_DOUBLE_EQ(*mean.microseconds, 115);
        // t(0.975, 2) times the standard error; means over scenes have n - 2 degrees of freedom
        EXPECT_NEAR(*mean.high - 115, 4.302653 * 6.4549722, 1e-3);
        EXPECT_NEAR(115 - *mean.low, 4.302653 * 6.4549722, 1e-3);
    }
    const EstimateRow& street = only_of(made.errors.tables, "street");
    EXPECT_DOUBLE_EQ(*street.microseconds, 50);
    EXPECT_DOUBLE_EQ(*street.high, 50) << "one place has no interval";
    ASSERT_EQ(kinds.size(), 2u);
    EXPECT_EQ(kinds[0].group, "rooms");
    EXPECT_EQ(kinds[0].places, 4u);
    EXPECT_EQ(kinds[0].sizes, std::vector<std::string>{"1920x1080"});
    EXPECT_NEAR(kinds[0].widest, 4.302653 * 6.4549722 / 115, 1e-5);
}

TEST(CostsOfPlaces, APlaceThatRefusesRefusesTheMean) {
    BothStudies made;
    made.costs.add("r500", "rooms", {});
    take_costs_from(made.costs.tables, "navi21", made.errors.tables);
    EXPECT_FALSE(only_of(made.errors.tables, "still").microseconds);
    EXPECT_EQ(only_of(made.errors.tables, "still").refusal, "spills");
    EXPECT_TRUE(only_of(made.errors.tables, "street").microseconds);
}

TEST(CostsOfPlaces, WhatDoesNotMatchIsNamed) {
    const auto message_of = [](const std::string& chip, BothStudies made) {
        return error_message([&] { take_costs_from(made.costs.tables, chip, made.errors.tables); });
    };
    EXPECT_NE(message_of("navi12", {}).find("navi21"), std::string::npos) << "a near name";
    BothStudies other_kind;
    other_kind.errors.add_shot("cave", "caves");
    EXPECT_NE(message_of("navi21", other_kind).find("no place for cave"), std::string::npos);
    BothStudies prefix;
    prefix.errors.add_shot("long", "roomsome");
    EXPECT_NE(message_of("navi21", prefix).find("no place for long"), std::string::npos) << "whole words";
    BothStudies other_rays;
    other_rays.costs.tables.manifest["techniques"][0]["parameters"]["rays"] = 4;
    EXPECT_NE(message_of("navi21", other_rays).find("v a has another rays"), std::string::npos);
    BothStudies unfinished;
    unfinished.costs.add_shot("r600", "rooms");
    unfinished.costs.tables.manifest["techniques"].push_back({{"technique", "w"}, {"point", "b"}});
    EstimateRow only = unfinished.costs.tables.estimates.front();
    only.technique = "w", only.point = "b";
    unfinished.costs.tables.estimates.push_back(only);
    EXPECT_NE(message_of("navi21", unfinished).find("not complete"), std::string::npos);
}
