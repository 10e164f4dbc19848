#include "core/wrapped_text.h"

#include <gtest/gtest.h>
#include <sstream>

TEST(WrappedText, BreaksBetweenWordsAndCountsLetters) {
    EXPECT_EQ(wrapped("one two three", 2, 9), "  one two\n  three\n");
    EXPECT_EQ(wrapped("one two three", 2, {}), "  one two three\n");
    EXPECT_EQ(wrapped("unbreakable", 2, 9), "  unbreakable\n");
    EXPECT_EQ(wrapped("\u00e4\u00e4\u00e4 \u00e4\u00e4\u00e4", 0, 7), "\u00e4\u00e4\u00e4 \u00e4\u00e4\u00e4\n");
}

TEST(WrappedText, MeaningsStandBesideNamesOrBelow) {
    EXPECT_EQ(beside("  --out DIR", "Folder", 14, 80), "  --out DIR   Folder\n");
    EXPECT_EQ(beside("  --out DIR", "Folder", 14, {}), "  --out DIR   Folder\n");
    EXPECT_EQ(beside("  --a-long-name DIR", "Folder", 14, 80), "  --a-long-name DIR\n              Folder\n");
    EXPECT_EQ(beside("  --out DIR", "Folder", 14, 40), "  --out DIR\n      Folder\n") << "26 columns are too few";
    EXPECT_EQ(beside("  --flag", "", 14, {}), "  --flag\n");
}

TEST(WrappedText, FittedLinesKeepTheirWordsAndFit) {
    const std::string lines = "name  default 1, range [0, 2]\n" + std::string(30, ' ') + "what it means, in words\n";
    EXPECT_EQ(fitted(lines, {}), lines);
    EXPECT_EQ(fitted(lines, 80), lines);
    const auto words_of = [](const std::string& text) {
        std::istringstream in(text);
        std::string words;
        for (std::string word; in >> word;) words += word + " ";
        return words;
    };
    for (const size_t columns : {20, 40, 60}) {
        std::istringstream fit(fitted(lines, columns));
        for (std::string line; std::getline(fit, line);) EXPECT_LE(line.size(), columns) << line;
        EXPECT_EQ(words_of(fitted(lines, columns)), words_of(lines));
    }
}

TEST(WrappedText, CutsBetweenLetters) {
    EXPECT_EQ(cut_to("four", 4), "four");
    EXPECT_EQ(cut_to("fives", 4), "f...");
    EXPECT_EQ(cut_to("\u00e4\u00e4\u00e4\u00e4\u00e4", 4), "\u00e4...");
}
