// SPDX-License-Identifier: Apache-2.0
// Problems drawn in lanes: those of search/generators/drawing.h and search/generators/choices.h, word by
// word; included once by the file of each instruction set.

#include "search/lanes/lanes.h"

namespace stiction {
namespace {

// The finalizer of splitmix64 (Mix).
inline Word MixWords(Word word) {
  word = (word ^ (word >> 30)) * 0xbf58476d1ce4e5b9u;
  word = (word ^ (word >> 27)) * 0x94d049bb133111ebu;
  return word ^ (word >> 31);
}

// Bits 64 and up of x y, for y < 2^32.
inline Word HighWord(Word x, std::uint64_t y) {
  const Word low = (x & 0xffffffffu) * y, high = (x >> 32) * y;
  return (high + (low >> 32)) >> 32;
}

// Of integers below 2^52.
inline Real RealOf(Word x) { return (Real)(x | AllWords(0x4330000000000000u)) - 0x1p52; }

// Choices, a sequence to each lane.
class LaneChoices {
 public:
  explicit LaneChoices(Word seed) : state_(seed) {}

  // The next word, of the lanes that draw one.
  Word Next(Mask draws) {
    state_ += (Word)draws & AllWords(0x9e3779b97f4a7c15u);
    return MixWords(state_);
  }
  Word Next() { return Next(~Never()); }
  // Uniform in 0, ..., range - 1.
  Word Below(std::uint64_t range) { return HighWord(Next(), range); }

  // `count` choices in [low, low + range), `digits` to a word, written to values[0 ... most - 1]: where there
  // are less in a lane, what is behind them is no choice.
  // The digits are those of Choices::DigitsPerWord.
  template <int kLow, int kRange, int kDigits, int kMost>
  void ForEach(Real count, Real (&values)[kMost]) {
    for (int first = 0; first < kMost; first += kDigits) {
      const Mask draws = count > static_cast<double>(first);
      if (!Any(draws)) return;
      Word fraction = Next(draws);
      for (int i = first; i < kMost && i < first + kDigits; ++i) {
        values[i] = RealOf(HighWord(fraction, kRange)) + static_cast<double>(kLow);
        fraction *= AllWords(kRange);
      }
    }
  }

 private:
  Word state_;
};

template <int Rows>
class LaneDraws {
 public:
  LaneDraws(Block<Rows>& block, const LaneDraw& draw) : block_(block), draw_(draw) {}

  void Draw() {
    for (int i = 0; i < draw_.count; i += kLanes) {
      LaneChoices choices(Seeds(i));
      DrawFriction(choices, i);
      const Real columns = RealOf(choices.Below(Rows)) + 1.0;
      for (int lane = 0; lane < kLanes; ++lane)
        block_.columns[i + lane] = static_cast<std::int32_t>(columns[lane]);
      Real J[Rows * Rows] = {}, x[Rows] = {};  // J column by column
      Mask of_J = ~Never();
      switch (draw_.family) {
        case LaneFamily::kIntegers:
          choices.ForEach<-5, 11, 9>(columns * static_cast<double>(Rows), J);
          of_J = choices.Below(2) == 0;
          choices.ForEach<-5, 11, 9>(All(Rows), x);
          break;
        case LaneFamily::kPsd:
          choices.ForEach<-32768, 65536, 4>(columns * static_cast<double>(Rows), J);
          choices.ForEach<-2048, 4096, 5>(All(Rows), x);
          for (Real& entry : J) entry *= 0x1p-15;
          for (Real& entry : x) entry *= 0x1p-11;
          of_J = Never();
          break;
        case LaneFamily::kSmall:
          choices.ForEach<-4, 9, 10>(columns * static_cast<double>(Rows), J);
          choices.ForEach<-2, 5, 13>(All(Rows), x);
          for (Real& entry : J) entry -= Max(All(-2), Min(entry, All(2)));
          break;
      }
      SetGram(J, columns, i);
      SetImage(J, columns, of_J, x, i);
    }
  }

 private:
  Word Seeds(int i) const {
    Word index;
    for (int lane = 0; lane < kLanes; ++lane)
      index[lane] = static_cast<std::uint64_t>(draw_.first + i + lane + 1);
    return MixWords(AllWords(draw_.unit_seed) + index * draw_.odd);
  }

  void DrawFriction(LaneChoices& choices, int i) {
    const Mask single = choices.Below(2) == 0;
    const Word first = choices.Below(draw_.palette);
    for (int lane = 0; lane < kLanes; ++lane) {
      block_.mu[0][i + lane] = draw_.mu[first[lane]];
      block_.friction[i + lane] = static_cast<std::int32_t>(first[lane]);
    }
    for (int contact = 1; contact < Rows / 2; ++contact) {
      const Word next = HighWord(choices.Next(~single), draw_.palette);
      for (int lane = 0; lane < kLanes; ++lane) {
        const double mu = draw_.mu[single[lane] != 0 ? first[lane] : next[lane]];
        block_.mu[contact][i + lane] = mu;
        if (mu != block_.mu[0][i + lane]) block_.friction[i + lane] = -1;
      }
    }
  }

  // A = J J'.
  void SetGram(const Real (&J)[Rows * Rows], Real columns, int i) {
    for (int row = 0; row < Rows; ++row) {
      for (int j = 0; j <= row; ++j) {
        Real sum = J[row] * J[j];
        for (int k = 1; k < Rows; ++k)
          sum = Select(columns > static_cast<double>(k), sum + J[Rows * k + row] * J[Rows * k + j], sum);
        A_[row][j] = A_[j][row] = sum;
      }
    }
    for (int row = 0; row < Rows; ++row) {
      for (int j = 0; j < Rows; ++j) Store(A_[row][j], block_.A[row][j] + i);
    }
  }

  // b = J x, or A x. A sum that begins at +0 stays as it is when a zero is added.
  void SetImage(const Real (&J)[Rows * Rows], Real columns, Mask of_J, const Real (&x)[Rows], int i) {
    for (int row = 0; row < Rows; ++row) {
      Real sum = All(0);
      for (int k = 0; k < Rows; ++k) {
        const Mask used = ~of_J | (columns > static_cast<double>(k));
        const Real factor = Select(of_J, J[Rows * k + row], A_[row][k]);
        sum = Select(used, sum + factor * x[k], sum);
      }
      Store(sum, block_.b[row] + i);
    }
  }

  Block<Rows>& block_;
  const LaneDraw draw_;
  Real A_[Rows][Rows];
};

}  // namespace
}  // namespace stiction
