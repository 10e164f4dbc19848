#include "core/shown_text.h"

#include <gtest/gtest.h>

TEST(ShownText, IsNotObeyedByATerminal) {
    EXPECT_EQ(shown_text("a\nerror: forged\r\t"), "a\\nerror: forged\\r\\t");
    EXPECT_EQ(shown_text("\x1b[31m \x7f"), "\\x1b[31m \\x7f");
    EXPECT_EQ(shown_text(std::string_view("\0", 1)), "\\x00");
    EXPECT_EQ(shown_text("\xc2\x9b \xe2\x80\xae \xe2\x80\xa8 \xe2\x81\xa6"), "\\u009b \\u202e \\u2028 \\u2066");
}

TEST(ShownText, BytesThatAreNoUtf8) {
    EXPECT_EQ(shown_text("\x9b\xff"), "\\x9b\\xff");
    EXPECT_EQ(shown_text("caf\xe9"), "caf\\xe9");                                  // cut off
    EXPECT_EQ(shown_text("\xc0\x9b \xe0\x80\x9b"), "\\xc0\\x9b \\xe0\\x80\\x9b");  // longer than they have to be
    EXPECT_EQ(shown_text("\xed\xa0\x80 \xf4\x90\x80\x80"),
              "\\xed\\xa0\\x80 \\xf4\\x90\\x80\\x80");  // a surrogate; beyond Unicode
}

TEST(ShownText, OthersStay) {
    const std::string text = "amd_sssr \xc3\xa9 \xe2\x86\x92 \xf0\x9f\x98\x80 \\n $(a)";
    EXPECT_EQ(shown_text(text), text);
    EXPECT_TRUE(is_utf8(text));
    EXPECT_FALSE(is_utf8("caf\xe9"));
}
