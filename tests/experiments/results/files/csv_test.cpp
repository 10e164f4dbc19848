#include "experiments/results/files/csv.h"

#include "core/files.h"

#include <gtest/gtest.h>

/// A spreadsheet takes none of them for a formula, and CsvReader none for another text.
TEST(Csv, NoTextIsAFormulaAndAllReadBack) {
    const std::vector<std::string> texts = {"=HYPERLINK(\"http://x\")",
                                            "+1+cmd|' /C calc'!A0",
                                            "-2+3",
                                            "@SUM(1)",
                                            "\t=1",
                                            "\r=1",
                                            "'=1",
                                            "''@",
                                            "=1\n=2",
                                            "a,b",
                                            "a\"b",
                                            "'a",
                                            "amd_sssr taps=4",
                                            ""};
    std::string text = "name,number,last\n";
    for (const std::string& t : texts) text += csv_line(t, std::string("-0.5"), t);
    EXPECT_NE(text.find("\n'-2+3,-0.5,'-2+3\n"), std::string::npos) << "numbers stay numbers";
    const std::filesystem::path file = std::filesystem::temp_directory_path() / "formulas.csv";
    write_text(file, text);
    CsvReader csv(file);
    for (const std::string& t : texts) {
        ASSERT_TRUE(csv.next());
        EXPECT_EQ(csv.text("name"), t);
        EXPECT_EQ(csv.number("number"), -0.5);
        EXPECT_EQ(csv.text("last"), t);
    }
    EXPECT_FALSE(csv.next());
}
