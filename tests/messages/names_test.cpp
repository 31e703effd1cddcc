// Text from files, logs and the network is shown, never obeyed.
#include "messages/names.h"

#include <gtest/gtest.h>

namespace whirl_twin {
namespace names_test {

TEST(Printable, TextIsShownAsItIs) {
  for (const char* text : {"rotor", "k = 2e4 N/m", "\u03c9\u00b2 \u2212 p\u00b2", "\U0001f300"}) {
    EXPECT_EQ(printable(text), text);
  }
}

TEST(Printable, WhatATerminalObeysIsNot) {
  EXPECT_EQ(printable("x\x1b[2J\x1b[31mred\nnext\r\t\x7f"), "x?[2J?[31mred?next???");
  EXPECT_EQ(printable(std::string("a\0b", 3)), "a?b");
  // C1, which begin a command like ESC [ does; a mark that turns the rest of a line round.
  EXPECT_EQ(printable("a\u009b2Jb"), "a??2Jb");
  EXPECT_EQ(printable("a\u202eb\u2066c\u2028d"), "a???b???c???d");
}

TEST(Printable, WhatIsNoUtf8IsNot) {
  EXPECT_EQ(printable("caf\xe9 \x9b"), "caf? ?");
  EXPECT_EQ(printable("\xc0\x9b|\xe0\x80\x9b|\xed\xa0\x80|\xf4\x90\x80\x80|\xe2\x82"),
            "??|???|???|????|??");
}

TEST(Printable, IsCutBetweenCharacters) {
  const std::string long_text = std::string(kLongestShown - 1, 'a') + "\u00e9 and more";
  EXPECT_EQ(printable(long_text), std::string(kLongestShown - 1, 'a') + "...");
  EXPECT_EQ(printable(std::string(kLongestShown, 'a')), std::string(kLongestShown, 'a'));
  EXPECT_EQ(printable("abcdef", 3), "abc...");
}

TEST(PrintableLines, KeepsLinesAndTabs) {
  EXPECT_EQ(printableLines("a\tb\n\x1b[1mc\r\n"), "a\tb\n?[1mc?\n");
  EXPECT_EQ(printableLines(std::string(200, 'a')), std::string(200, 'a'));
}

}  // namespace names_test
}  // namespace whirl_twin
