// The table of advice: made of made-up studies with a known winner, kept, read and asked.
#include "experiments/results/advice/advice_answer.h"

#include "tests/error_message.h"
#include "tests/experiments/cli/command_line_fixture.h"

#include <regex>
#include <set>

namespace {

using nlohmann::json;

/// A study of errors in five rooms at rest, and one of costs in four. `good` errs half as much as `near` ... `bad`.
struct MadeAdvice {
    StudyResults errors, costs;

    MadeAdvice() {
        for (StudyResults* study : {&errors, &costs}) {
            study->manifest = {{"title", "Made up"},
                               {"study", {{"config", "made_up.json"}}},
                               {"provenance", {{{"ssrlab", {{"commit", "abc1234"}}}}}},
                               {"shots", json::array()},
                               {"techniques", json::array()}};
            for (const char* technique : {"none", "good", "near", "bad", "dear"})
                study->manifest["techniques"].push_back({{"technique", technique},
                                                         {"point", "default"},
                                                         {"parameters", {{"rays", 1}, {"stride", 4}}},
                                                         {"entry", {{"technique", technique}}}});
            study->manifest["techniques"][1]["entry"]["parameters"] = {{"rays", 1}, {"march", "cells, refined"}};
        }
        for (int i = 0; i < 5; ++i) {
            const std::string shot = "room_" + std::to_string(i);
            add_shot(errors, shot, "rooms, at rest", 320, 180);
            const double scatter = 1 + 0.02 * (i % 3), other = 1 + 0.03 * (i % 2);
            for (const char* mask : {"reflective", "roughness_0_0.1"}) {
                add_error(shot, mask, "none", 2), add_error(shot, mask, "good", 0.5 * scatter);
                add_error(shot, mask, "near", 0.51 * other), add_error(shot, mask, "bad", 1.5 * other);
                add_error(shot, mask, "dear", 0.1);
            }
        }
        for (int i = 0; i < 4; ++i) {
            const std::string shot = "place_" + std::to_string(i);
            add_shot(costs, shot, "rooms", 1920, 1080);
            add_time(shot, "good", 800 + 10 * i), add_time(shot, "near", 450 + i), add_time(shot, "bad", 400 + i);
            add_time(shot, "dear", 9000);
        }
    }

    static void add_shot(StudyResults& study, const std::string& shot, const std::string& group, int width,
                         int height) {
        study.manifest["shots"].push_back(
            {{"shot", shot}, {"scene", shot}, {"group", group}, {"width", width}, {"height", height}});
    }
    void add_error(const std::string& shot, const std::string& mask, const std::string& technique, double error) {
        MetricSummary e{.shot = shot,
                        .frame = "0",
                        .technique = technique,
                        .point = "default",
                        .target = "specular",
                        .metric = "flip",
                        .mask = mask};
        e.value = error, e.low = 0.99 * error, e.high = 1.01 * error;
        e.ranked = e.represents_shot = true;
        errors.summary.push_back(e);
    }
    void add_time(const std::string& shot, const std::string& technique, double us) {
        EstimateRow row;
        row.shot = shot, row.technique = technique, row.point = "default", row.stage = "total";
        row.chip = "navi21", row.driver = "Mesa 22.3.6", row.microseconds = us;
        costs.estimates.push_back(row);
    }
    Advice made() const { return make_advice({errors}, {costs}); }
};

struct KeptAdvice : CommandLine {
    fs::path csv = folder / "advice.csv";
    Advice kept(const Advice& made) const {
        write_advice(csv, made);
        return read_advice(csv);
    }
};

const AdviceQuestion asked{.chip = "navi21", .ms = 1.0, .place = "room", .movement = "at rest", .surface = "all"};

bool says(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

const AdviceRow& row_of(const Advice& advice, const std::string& technique, std::optional<double> ms) {
    return *std::ranges::find_if(advice.rows, [&](const AdviceRow& row) {
        return row.technique == technique && row.ms == ms && row.surface == "all";
    });
}

}  // namespace

TEST_F(KeptAdvice, NamesTheWinnerWithinABudget) {
    const Advice advice = kept(MadeAdvice().made());
    const AdviceRow &good = row_of(advice, "good", 1.0), &dear = row_of(advice, "dear", 1.0);
    EXPECT_EQ(good.rank, 1.0);
    EXPECT_NEAR(*good.ratio, 0.25, 0.01);
    EXPECT_EQ(good.scenes, 5u);
    EXPECT_EQ(good.places, 4u);
    EXPECT_NEAR(*good.us, 815, 1e-9);
    EXPECT_LT(*good.us_low, 815);
    EXPECT_EQ(dear.reason, above_budget);
    EXPECT_FALSE(dear.ratio);
    EXPECT_EQ(row_of(advice, "near", 0.5).rank, 1.0) << "good takes 0.8 ms";
    EXPECT_EQ(row_of(advice, "dear", {}).rank, 1.0) << "at any cost";

    const std::string answer = advice_answer(advice, asked);
    for (const char* part :
         {"navi21, 1 ms, rooms, at rest, all reflective surfaces\n  Use good,",
          R"(defaults: {"march":"cells, refined","rays":1})", "times the error without reflections, over 5 of 5 scenes",
          "Estimated time: 0.815 [", "mean over 4 places",
          "within the margin of the studies): near 0.258 [0.253, 0.263], probability 0.0",
          "Certainly worse: bad 0.759 [", "Does not fit, by its cheapest point: dear takes 9 ms",
          "Errors: made_up.json (320x180, commit abc1234)",
          "Times: made_up.json (1920x1080, commit abc1234), navi21: Mesa 22.3.6", "0.22 to 12.8 times such estimates"})
        EXPECT_TRUE(says(answer, part)) << part << "\n" << answer;
}

TEST_F(KeptAdvice, TheTableReadsBackAsItWasMade) {
    const Advice made = MadeAdvice().made(), read = kept(made);
    ASSERT_EQ(read.rows.size(), made.rows.size());
    for (size_t i = 0; i < made.rows.size(); ++i) EXPECT_EQ(row_json(read.rows[i]), row_json(made.rows[i]));
    EXPECT_EQ(read.sources, made.sources);
    std::set<std::string> surfaces;
    for (const AdviceRow& row : read.rows) surfaces.insert(row.surface);
    EXPECT_EQ(surfaces, (std::set<std::string>{"all", "mirrors"})) << "the masks that the study has";
    EXPECT_EQ(read.sources["costs"][0]["compilers"]["navi21"], "Mesa 22.3.6");
}

TEST_F(KeptAdvice, WritesPointsAsAStudyTakesThem) {
    const Advice advice = kept(MadeAdvice().made());
    EXPECT_EQ(advised_points(advice, asked),
              json::parse(R"([{"technique": "good", "parameters": {"march": "cells, refined", "rays": 1}}])"));
    EXPECT_EQ(advised_points(advice, {}).size(), 2u) << "good and near, each once";
    Advice two = advice;
    for (AdviceRow& row : two.rows)
        if (row.technique == "near") row.technique = "good", row.point = "rays=2";
    two.sources["points"]["good"]["rays=2"] = {{"rays", 2}};
    EXPECT_EQ(advised_points(two, {}),
              json::parse(R"([{"technique": "good", "sweep": {"march": ["cells, refined"], "rays": [1]}},
                                                       {"technique": "good", "sweep": {"rays": [2]}}])"));
}

TEST_F(KeptAdvice, AShortQuestionGetsATable) {
    const std::string answer = advice_answer(kept(MadeAdvice().made()), {});
    EXPECT_TRUE(says(answer, "navi21  0.5 ms  rooms, at rest   near")) << answer;
    EXPECT_TRUE(says(answer, "navi21  4 ms    rooms, at rest   good")) << answer;
}

TEST_F(KeptAdvice, SaysWhichBudgetItAnswers) {
    const Advice advice = kept(MadeAdvice().made());
    AdviceQuestion question = asked;
    EXPECT_FALSE(says(advice_answer(advice, question), "has no budget"));
    question.ms = 1.7;
    EXPECT_TRUE(says(advice_answer(advice, question), "The answer is for the nearest lower one, 1 ms."));
    question.ms = 1000;
    EXPECT_TRUE(says(advice_answer(advice, question), "Nothing dearer than 4 ms was studied"));
    const auto message_at = [&](double ms) {
        question.ms = ms;
        return error_message([&] { advice_answer(advice, question); });
    };
    EXPECT_TRUE(says(message_at(0.1), "nothing fits within 0.1 ms on navi21; the cheapest point, bad, takes 0.402 ["));
    EXPECT_TRUE(says(message_at(0.45), "nothing was studied for 0.45 ms on navi21; the cheapest point"));
}

TEST_F(KeptAdvice, NamesWhatTheTableHas) {
    const Advice advice = kept(MadeAdvice().made());
    const auto message_of = [&](std::string AdviceQuestion::*member, const std::string& value) {
        AdviceQuestion question = asked;
        question.*member = value;
        return error_message([&] { advice_answer(advice, question); });
    };
    EXPECT_TRUE(says(message_of(&AdviceQuestion::chip, "gfx1100"),
                     "no chip 'gfx1100'; it has navi21 (Radeon RX 6800 XT). To add one, name"));
    EXPECT_TRUE(says(message_of(&AdviceQuestion::place, "cave"), "no place 'cave'; it has rooms. To add one, run"));
    EXPECT_TRUE(says(message_of(&AdviceQuestion::movement, "in motion"), "no movement 'in motion'; it has at rest"));
    EXPECT_TRUE(says(message_of(&AdviceQuestion::surface, "rough"), "no surface 'rough'; it has all, mirrors"));
}

TEST_F(KeptAdvice, NothingHelpsIfAllErrMore) {
    MadeAdvice worse;
    for (MetricSummary& e : worse.errors.summary)
        if (e.technique != "none") e.value = *e.value + 5, e.low = *e.value * 0.99, e.high = *e.value * 1.01;
    const Advice advice = kept(worse.made());
    EXPECT_TRUE(says(advice_answer(advice, asked), "Nothing that fits errs less than an image without reflections."));
    EXPECT_TRUE(says(error_message([&] { advised_points(advice, asked); }), "ask for a larger budget"));
}

TEST_F(KeptAdvice, StudiesThatDoNotServeAreRefused) {
    const auto message_of = [](const MadeAdvice& made) { return error_message([&] { made.made(); }); };
    MadeAdvice nameless, twice, no_times, other_metric, no_none, other_rays;
    nameless.errors.manifest["shots"][0]["group"] = "rooms";
    EXPECT_TRUE(says(message_of(nameless), "'rooms' names no place and movement"));
    EXPECT_TRUE(says(error_message([&] { make_advice({twice.errors, twice.errors}, {twice.costs}); }), "two studies"));
    for (json& shot : other_rays.errors.manifest["shots"]) shot["group"] = "rooms, in motion";
    other_rays.errors.manifest["techniques"][1]["entry"]["parameters"]["rays"] = 2;
    EXPECT_TRUE(says(error_message([&] {
                         make_advice({twice.errors, other_rays.errors}, {twice.costs});
                     }),
                     "good default has other parameters in another study"));
    EXPECT_TRUE(says(error_message([&] {
                         make_advice({twice.errors}, {twice.costs, twice.costs});
                     }),
                     "two studies of costs have times of navi21"));
    no_times.costs.estimates.clear();
    EXPECT_TRUE(says(message_of(no_times), "gpu_compilers"));
    for (MetricSummary& e : other_metric.errors.summary) e.metric = "mse";
    EXPECT_TRUE(says(message_of(other_metric), "no errors of specular flip"));
    std::erase_if(no_none.errors.manifest["techniques"].get_ref<json::array_t&>(),
                  [](const json& v) { return v["technique"] == "none"; });
    EXPECT_TRUE(says(message_of(no_none), "no technique `none`"));
}

TEST_F(KeptAdvice, ChipsCanComeFromStudiesOfTheirOwn) {
    MadeAdvice two;
    StudyResults other = two.costs;
    for (EstimateRow& e : other.estimates) e.chip = "gfx1201", e.driver = "Mesa 25.0.7", *e.microseconds *= 2;
    const Advice advice = kept(make_advice({two.errors}, {two.costs, other}));
    const auto cheapest = [&](const std::string& chip) {
        double least = 1e9;
        for (const AdviceRow& row : advice.rows)
            if (row.chip == chip && row.us) least = std::min(least, *row.us);
        return least;
    };
    EXPECT_DOUBLE_EQ(cheapest("gfx1201"), 2 * cheapest("navi21"));
    AdviceQuestion question = asked;
    question.chip = "gfx1201", question.ms = 4;
    const std::string answer = advice_answer(advice, question);
    EXPECT_TRUE(says(answer, "gfx1201: Mesa 25.0.7"));
    EXPECT_FALSE(says(answer, "Mesa 22.3.6"));
}

TEST_F(KeptAdvice, ADamagedTableSaysHowToMakeIt) {
    const auto message = [&] { return error_message([&] { read_advice(csv); }); };
    EXPECT_TRUE(says(message(), "advice.csv is missing; experiments/docs/advise.md says how to make the table"));
    const Advice made = MadeAdvice().made();
    kept(made);
    const std::string whole = read_text(csv);
    const auto message_of = [&](const std::string& text) {
        write_text(csv, text);
        return message();
    };
    EXPECT_TRUE(says(message_of(""), "is empty"));
    EXPECT_TRUE(says(message_of(whole.substr(0, whole.find('\n') + 1)), " has 0 rows, and "));
    EXPECT_TRUE(says(message_of(whole.substr(0, whole.size() / 2)), "experiments/docs/advise.md"));
    EXPECT_TRUE(says(message_of("chip,ms\nnavi21,1\n"), "has no column 'place'"));
    kept(made);
    write_text(folder / "advice.json",
               std::regex_replace(read_text(folder / "advice.json"), std::regex("\"dear\""), "\"d\""));
    EXPECT_TRUE(says(message(), "advice.json has no parameters of dear default"));
    fs::remove(folder / "advice.json");
    EXPECT_TRUE(says(message(), "advice.json is missing"));
    write_text(folder / "advice.json", "{}");
    EXPECT_TRUE(says(message(), "advice.json"));
}

TEST_F(KeptAdvice, TheCommandRefusesWhatIsNoQuestion) {
    kept(MadeAdvice().made());
    const Outcome answer = ssrlab("advise --table advice.csv --chip navi21 --ms 1 --place room --rest");
    EXPECT_EQ(answer.code, 0) << answer.text;
    EXPECT_TRUE(says(answer.text, "Use good,")) << answer.text;
    const Outcome points = ssrlab("advise --table advice.csv --chip navi21 --ms 1 --json -");
    EXPECT_EQ(json::parse(points.text, nullptr, false).size(), 1u) << points.text;
    for (const char* options : {"--ms 0", "--ms -1", "--ms much", "--surface wet", "--rest --motion"})
        EXPECT_EQ(ssrlab(std::string("advise --table advice.csv ") + options).code, 2) << options;
    expect_mistake("advise --table absent.csv", "absent.csv is missing");
    expect_mistake("advise --study results", "needs --study, --costs-from and --keep together");
    expect_mistake("advise --table advice.csv --chip navi21 --ms 0.1", "nothing fits within 0.1 ms");
}
