// SPDX-License-Identifier: Apache-2.0
// LaTeX of a report: nothing that stands in a store is a command.

#include "reports/papers/latex.h"

#include <catch2/catch.hpp>
#include <string>

#include "reports/tables/table.h"
#include "tests/scratch.h"

namespace stiction {
namespace {

using Catch::Matchers::Contains;
using testing::Scratch;

TEST_CASE("latex: every special character is escaped, brackets stand in braces") {
  CHECK(LatexText("near-degenerate") == "near-degenerate");
  CHECK(
      LatexText(R"(a\b{c}$d&e#f_g%h~i^j<k>l"m[n])") ==
      R"(a\textbackslash{}b\{c\}\$d\&e\#f\_g\%h\textasciitilde{}i\textasciicircum{}j\textless{}k\textgreater{}l)"
      R"({''}m{[}n{]})");
  CHECK(LatexText("a\nb\x7f") == "a?b?");
}

TEST_CASE("latex: names of a store are text in tables, figures and the citation") {
  const Scratch scratch;
  const std::string name = R"(\input{/etc/passwd} 100% $_#&, more)";
  Store store(scratch / "s.store", {"{}", 7, R"(["paper"])"});
  Record record;
  Tally& tally = record.tallies[{name, 2, "paper"}];
  tally.problems = 10;
  tally.verdicts[static_cast<int>(Outcome::kCycle)][static_cast<int>(Outcome::kCycle)] = 1;
  Work work;
  const std::string version = name.substr(0, name.find(','));
  work.builds.insert(version + ", a compiler");
  store.AddUnit({}, 0, record, {}, {}, work);
  auto files = LatexFiles(store);
  files["citation.bib"] = Citation(store);
  for (const auto& [file, text] : files) {
    INFO(file);
    CHECK_THAT(text, !Contains(R"(\input{/etc)"));
    CHECK_THAT(text, !Contains("100% ") && !Contains("$_"));
  }
  CHECK_THAT(files.at("latex/loops.tex"), Contains(LatexText(name) + " & paper & double & 2 & 10 & 1 & "));
  CHECK_THAT(files.at("latex/figure-loops.tex"), Contains("\\legend{{" + LatexText(name) + "}}"));
  CHECK_THAT(files.at("citation.bib"), Contains("version " + LatexText(version) + "}"));
}

}  // namespace
}  // namespace stiction
