// SPDX-License-Identifier: Apache-2.0
#include "reports/papers/latex.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "corpus/counts.h"
#include "corpus/grouped.h"
#include "corpus/intervals.h"
#include "reports/html/html.h"

namespace stiction {
namespace {

using LatexRow = std::vector<std::string>;

// A table that may go over pages: the first `names` columns to the left, the others to the right.
std::string LatexTable(const std::string& caption, const std::string& label, const LatexRow& header,
                       std::size_t names, const std::vector<LatexRow>& rows) {
  std::string columns = std::string(names, 'l') + std::string(header.size() - names, 'r');
  std::string text = fmt::format(
      "% Written by stiction; needs booktabs and "
      "longtable.\n\\begin{{longtable}}{{{0}}}\n\\caption{{{1}}}\\label{{{2}}}\\\\\n"
      "\\toprule\n{3} \\\\\n\\midrule\n\\endfirsthead\n\\toprule\n{3} \\\\\n\\midrule\n\\endhead\n",
      columns, caption, label, fmt::join(header, " & "));
  for (const LatexRow& row : rows) text += fmt::format("{} \\\\\n", fmt::join(row, " & "));
  return text + "\\bottomrule\n\\end{longtable}\n";
}

// "550 [480, 627]" in which no bracket is an option.
std::string Rate(std::int64_t count, std::int64_t runs) { return LatexText(RateText(count, runs)); }
std::string Share(std::int64_t count, std::int64_t of) { return LatexText(ShareText(count, of)); }

std::string LoopsTable(const Record& record) {
  std::vector<LatexRow> rows;
  for (const auto& [key, counts] : CountBy(record, [](const TallyKey& key) { return key; })) {
    rows.push_back({LatexText(key.generator), LatexText(key.policy), LatexText(key.arithmetic),
                    Grouped(key.contacts), Grouped(counts.runs), Grouped(counts.Loops()),
                    Rate(counts.Loops(), counts.runs)});
  }
  return LatexTable(
      "Loops of the published algorithm, confirmed in exact arithmetic, in a million runs, with exact "
      "intervals at "
      "95\\,\\% (Garwood). They are lower bounds where runs were not all repeated exactly.",
      "tab:stiction-loops",
      {"generator", "policy", "arithmetic", "contacts", "runs", "loops", "in a million {[95\\,\\%]}"}, 3,
      rows);
}

// By policy and contacts, over all generators.
std::pair<std::string, int> BySize(const TallyKey& key) { return {key.policy, key.contacts}; }

std::string ContactsTable(const Record& record) {
  std::vector<LatexRow> rows;
  for (const auto& [key, size] : MergeBy(record, &BySize)) {
    Counts counts;
    counts.Add(size);
    rows.push_back({LatexText(key.first), Grouped(key.second), Grouped(counts.runs),
                    Mean(size.sums.steps, counts.runs), Share(size.with_zero_steps, counts.runs),
                    Share(size.with_give_ups, counts.runs), Rate(counts.Loops(), counts.runs)});
  }
  return LatexTable(
      "Runs by number of contacts, all generators together: steps in the mean; runs with a step of length "
      "zero, and "
      "with something given up, as shares with exact intervals at 95\\,\\% (Clopper and Pearson); loops "
      "confirmed "
      "exactly, in a million runs (Garwood).",
      "tab:stiction-contacts",
      {"policy", "contacts", "runs", "steps", "with zero steps", "with give-ups", "loops"}, 1, rows);
}

std::string MethodsTable(const Record& record) {
  std::vector<LatexRow> rows;
  for (const auto& [contacts, existence] : record.existence) {
    const auto found = record.agreement.find(contacts);
    const AgreementTally agreement = found == record.agreement.end() ? AgreementTally{} : found->second;
    rows.push_back({Grouped(contacts), Grouped(existence.problems), Grouped(existence.solved),
                    Grouped(existence.with_folds), Grouped(existence.with_descents),
                    Grouped(agreement.compared), Grouped(agreement.enumerated),
                    Grouped(agreement.disagreements)});
  }
  return LatexTable(
      "Complete driving on the problems that were given to it, and methods held against each other (published "
      "algorithm, complete driving, Lemke's method; all contact modes tried of some), by number of contacts. "
      "Each "
      "solution was verified exactly.",
      "tab:stiction-methods",
      {"contacts", "given", "solved", "with folds", "with descents", "compared", "all modes", "disagreements"},
      0, rows);
}

// ---- Figures: columns of numbers, and what draws them ----

// Rows by contacts; for each generator that has loops a rate in a million and how far its interval reaches; nan
// where there is no run or no loop, which a logarithmic axis cannot show.
struct LoopCurves {
  std::map<std::string, std::map<int, std::pair<std::int64_t, std::int64_t>>> curves;  // loops, runs

  explicit LoopCurves(const Record& record) {
    const auto by = [](const TallyKey& key) { return std::tuple(key.policy, key.generator, key.contacts); };
    for (const auto& [key, counts] : CountBy(record, by)) {
      const auto& [policy, generator, contacts] = key;
      if (policy == "paper") curves[generator][contacts] = {counts.Loops(), counts.runs};
    }
    std::erase_if(curves, [](const auto& curve) {
      return std::all_of(curve.second.begin(), curve.second.end(),
                         [](const auto& size) { return size.second.first == 0; });
    });
  }
  std::set<int> Contacts() const {
    std::set<int> all;
    for (const auto& [generator, sizes] : curves) {
      for (const auto& [contacts, counts] : sizes) all.insert(contacts);
    }
    return all;
  }
};

std::string LoopData(const LoopCurves& figure) {
  std::string text = "contacts";
  for (std::size_t i = 1; i <= figure.curves.size(); ++i) text += fmt::format(" g{0} g{0}minus g{0}plus", i);
  text += "\n";
  for (const int contacts : figure.Contacts()) {
    text += std::to_string(contacts);
    for (const auto& [generator, sizes] : figure.curves) {
      const auto found = sizes.find(contacts);
      if (found == sizes.end() || found->second.first == 0) {
        text += " nan nan nan";
        continue;
      }
      const auto [loops, runs] = found->second;
      const double scale = 1e6 / static_cast<double>(runs), count = static_cast<double>(loops);
      const Interval interval = CountInterval(loops);
      text += fmt::format(" {:.9g} {:.9g} {:.9g}", scale * count, scale * (count - interval.low),
                          scale * (interval.high - count));
    }
    text += "\n";
  }
  return text;
}

std::string FigureHead(const std::string& axis) {
  return fmt::format(
      "% Written by stiction; needs pgfplots. Where the data lie: \\newcommand{{\\stictiondata}}{{FOLDER}}\n"
      "\\providecommand{{\\stictiondata}}{{.}}\n\\begin{{tikzpicture}}\n\\begin{{axis}}[width=0.75\\linewidth, "
      "{}]\n",
      axis);
}

std::string LoopFigure(const LoopCurves& figure) {
  std::string text = FigureHead(
      "ymode=log, xlabel={contacts}, ylabel={loops in a million runs}, xtick=data, unbounded coords=discard, "
      "legend pos=outer north east, error bars/y dir=both, error bars/y explicit");
  std::size_t i = 0;
  for (const auto& [generator, sizes] : figure.curves) {
    text += fmt::format(
        "\\addplot+[error bars/.cd, y dir=both, y explicit] table[x=contacts, y=g{0}, y error minus=g{0}minus, "
        "y error plus=g{0}plus] {{\\stictiondata/loops.dat}};\n\\addlegendentry{{{1}}}\n",
        ++i, LatexText(generator));
  }
  return text + "\\end{axis}\n\\end{tikzpicture}\n";
}

// Rows by steps; for each number of contacts the share of its runs.
std::string StepData(const Record& record) {
  const auto sizes = MergeBy(record, &BySize);
  std::string text = "steps";
  for (const auto& [key, size] : sizes) {
    if (key.first == "paper") text += fmt::format(" c{}", key.second);
  }
  text += "\n";
  for (int steps = 0; steps < Tally::kBins; ++steps) {
    text += std::to_string(steps);
    for (const auto& [key, size] : sizes) {
      if (key.first != "paper") continue;
      text +=
          size.problems == 0
              ? " nan"
              : fmt::format(" {:.9g}", static_cast<double>(size.steps[steps]) / static_cast<double>(size.problems));
    }
    text += "\n";
  }
  return text;
}

std::string StepFigure(const Record& record) {
  std::string text =
      FigureHead(fmt::format("xlabel={{steps of a run ({} stands for more, too)}}, ylabel={{share of the "
                             "runs}}, legend pos=outer north east, "
                             "no markers, const plot",
                             Tally::kBins - 1));
  for (const auto& [key, size] : MergeBy(record, &BySize)) {
    if (key.first != "paper") continue;
    text += fmt::format(
        "\\addplot table[x=steps, y=c{0}] {{\\stictiondata/steps.dat}};\n\\addlegendentry{{{0} {1}}}\n",
        key.second, key.second == 1 ? "contact" : "contacts");
  }
  return text + "\\end{axis}\n\\end{tikzpicture}\n";
}

std::string Document(const CampaignIdentity& identity) {
  return fmt::format(R"(% Written by stiction: pdflatex report.tex, twice.
\documentclass[a4paper]{{article}}
\usepackage[utf8]{{inputenc}}
\usepackage[margin=2cm]{{geometry}}
\usepackage{{booktabs}}
\usepackage{{longtable}}
\usepackage{{pgfplots}}
\pgfplotsset{{compat=1.16}}
\title{{Endless runs of a contact force algorithm, as stiction counted them}}
\author{{}}
\date{{}}
\begin{{document}}
\maketitle
\noindent Seed {}, version {} of the algorithm.
\input{{loops.tex}}
\input{{contacts.tex}}
\input{{methods.tex}}
\begin{{figure}}\centering\input{{figure-loops.tex}}
\caption{{Loops confirmed exactly, by number of contacts, with exact intervals at 95\,\%; where none was met there is
no mark.}}\end{{figure}}
\begin{{figure}}\centering\input{{figure-steps.tex}}
\caption{{Steps of a run of the published algorithm, by number of contacts.}}\end{{figure}}
\end{{document}}
)",
                     identity.seed, identity.algorithm);
}

}  // namespace

std::string LatexText(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '\\':
        escaped += "\\textbackslash{}";
        break;
      case '~':
        escaped += "\\textasciitilde{}";
        break;
      case '^':
        escaped += "\\textasciicircum{}";
        break;
      case '<':
        escaped += "\\textless{}";
        break;
      case '>':
        escaped += "\\textgreater{}";
        break;
      case '"':
        escaped += "{''}";
        break;
      case '[':
        escaped += "{[}";
        break;  // behind \\ it would be a length
      case ']':
        escaped += "{]}";
        break;
      case '&':
      case '%':
      case '$':
      case '#':
      case '_':
      case '{':
      case '}':
        escaped += '\\';
        escaped += c;
        break;
      default:
        escaped += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? '?' : c;
    }
  }
  return escaped;
}

std::map<std::string, std::string> LatexFiles(const Store& store) {
  const Record record = store.Total();
  const LoopCurves curves(record);
  return {{"latex/report.tex", Document(store.identity())},
          {"latex/loops.tex", LoopsTable(record)},
          {"latex/contacts.tex", ContactsTable(record)},
          {"latex/methods.tex", MethodsTable(record)},
          {"latex/loops.dat", LoopData(curves)},
          {"latex/steps.dat", StepData(record)},
          {"latex/figure-loops.tex", LoopFigure(curves)},
          {"latex/figure-steps.tex", StepFigure(record)}};
}

std::string Citation(const Store& store) {
  std::string versions;  // "0.1.0 2060e9f249a5" of each build, whose compiler and flags follow
  for (const std::string& build : store.TotalWork().builds)
    versions += (versions.empty() ? "" : "; ") + build.substr(0, build.find(','));
  return fmt::format(R"(@misc{{stiction,
  author = {{{{The stiction authors}}}},
  title = {{stiction: a verification suite for the contact force algorithm of {{D.}} {{Baraff}}}},
  howpublished = {{Software, version {}}},
  note = {{Seed {}, version {} of the algorithm}}
}}

@inproceedings{{Baraff94,
  author = {{Baraff, David}},
  title = {{Fast Contact Force Computation for Nonpenetrating Rigid Bodies}},
  booktitle = {{Proceedings of SIGGRAPH 94}},
  year = {{1994}}
}}
)",
                     LatexText(versions), store.identity().seed, store.identity().algorithm);
}

}  // namespace stiction
