// SPDX-License-Identifier: Apache-2.0
// Histograms of steps per problem as inline SVG, one per number of contacts.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "reports/page.h"

namespace stiction {
namespace {

using Bins = std::array<std::int64_t, Tally::kBins>;

constexpr double kLeft = 34, kTop = 6, kHeight = 112, kBar = 5, kWidth = kBar * Tally::kBins;
constexpr double kBase = kTop + kHeight;
constexpr double kOne = 0.4;  // height of a count of one, in decades, lest it be invisible

// Decades between 1 and value: its logarithm, by linear interpolation within a decade's third. Drawn only, and
// the same on every machine since it needs no library function.
double Decades(std::int64_t value) {
  int decade = 0;
  double rest = static_cast<double>(value);
  for (; rest >= 10; rest /= 10) ++decade;
  constexpr double at2 = 0.30103, at5 = 0.69897;
  if (rest < 2) return decade + (rest - 1) * at2;
  if (rest < 5) return decade + at2 + (rest - 2) / 3 * (at5 - at2);
  return decade + at5 + (rest - 5) / 5 * (1 - at5);
}

class Chart {
 public:
  explicit Chart(const Bins& bins) : bins_(bins) {
    const std::int64_t most = *std::max_element(bins.begin(), bins.end());
    decades_ = 1;
    for (std::int64_t top = 10; top < most && decades_ < 18; top *= 10) ++decades_;
  }

  Html Draw(const std::string& label) const {
    const std::string view = fmt::format("0 0 {:.0f} {:.0f}", kLeft + kWidth + 6, kBase + 20);
    return Tag("svg", {{"viewBox", view}, {"role", "img"}, {"aria-label", label}})(Html("\n") + Scale() +
                                                                                   Bars() + Axis());
  }

 private:
  double Y(double decades) const { return kBase - kHeight * (decades + kOne) / (decades_ + kOne); }

  static Html Label(double x, double y, const char* anchor, const std::string& text) {
    return Tag("text", {{"x", Fixed(x)}, {"y", Fixed(y)}, {"text-anchor", anchor}})(text) + Html("\n");
  }

  static Html Line(double y) {
    const std::string at = Fixed(y);
    return Tag("line", {{"x1", Fixed(kLeft)}, {"x2", Fixed(kLeft + kWidth)}, {"y1", at}, {"y2", at}})("");
  }

  Html Scale() const {
    static const std::array<const char*, 7> names = {"1", "10", "100", "1k", "10k", "100k", "1M"};
    Html scale = Line(kBase);
    const int stride = decades_ > 4 ? 2 : 1;
    for (int decade = 0; decade <= decades_; decade += stride) {
      const std::string name =
          decade < 7 ? std::string(names[static_cast<std::size_t>(decade)]) : fmt::format("1e{}", decade);
      scale += Line(Y(decade)) + Label(kLeft - 4, Y(decade) + 4, "end", name);
    }
    return scale;
  }

  Html Bars() const {
    Html bars;
    for (int bin = 0; bin < Tally::kBins; ++bin) {
      if (bins_[bin] > 0) bars += Bar(bin);
    }
    return bars;
  }

  Html Bar(int bin) const {
    const double y = Y(Decades(bins_[bin]));
    const std::string more = bin == Tally::kBins - 1 ? " or more" : "";
    const std::string tip = fmt::format("{}{} step{}: {}", bin, more, bin == 1 ? "" : "s", Grouped(bins_[bin]));
    return Tag("rect", {{"x", Fixed(kLeft + kBar * bin + 0.5)},
                        {"y", Fixed(y)},
                        {"width", Fixed(kBar - 1)},
                        {"height", Fixed(kBase - y)}})(Tag("title")(tip)) +
           Html("\n");
  }

  static Html Axis() {
    Html axis;
    for (int bin = 0; bin < Tally::kBins - 8; bin += 10) {
      axis += Label(kLeft + kBar * (bin + 0.5), kBase + 14, "middle", std::to_string(bin));
    }
    return axis + Label(kLeft + kWidth, kBase + 14, "end", fmt::format("≥ {}", Tally::kBins - 1));
  }

  const Bins& bins_;
  int decades_;
};

Html Figure(int contacts, const Tally& tally) {
  const std::string label = fmt::format("{}: {}", Counted(contacts, "contact"), Counted(tally.problems, "run"));
  return Tag("figure")(Tag("figcaption")(label) + Chart(tally.steps).Draw("Steps per problem, " + label)) +
         Html("\n");
}

}  // namespace

Html StepsSection(const Record& total) {
  std::map<int, Tally> by_contacts;
  for (const auto& [key, tally] : total.tallies) by_contacts[key.contacts].Merge(tally);
  Html figures;
  for (const auto& [contacts, tally] : by_contacts) figures += Figure(contacts, tally);
  return Section("steps", "Steps per problem",
                 Html("<p>Across: steps until the run in doubles ended. Up: number of runs, on a logarithmic "
                      "scale.</p>\n") +
                     Tag("div", {{"class", "charts"}})(Html("\n") + figures) + Html("\n"));
}

}  // namespace stiction
