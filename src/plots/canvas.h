// A sheet to draw on, in pixels, x to the right and y downwards: as SVG (lines and letters stay
// sharp at any size) or as PNG. Drawn by Cairo.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "plots/thinning.h"

namespace whirl_twin {

enum class ImageFormat { kSvg, kPng };

/// By its extension, .svg or .png. Throws InputError.
ImageFormat imageFormat(const std::string& path);

/// A colour, each part from 0 to 1.
struct Ink {
  double red = 0.0, green = 0.0, blue = 0.0;
};
/// Mixed with `share` of white: 0 leaves it unchanged, 1 is white.
Ink paler(const Ink& ink, double share);
Ink darker(const Ink& ink, double share);

namespace ink {
// Colours distinguishable with every kind of colour vision (M. Okabe, K. Ito: Color Universal
// Design, 2008).
inline constexpr Ink kBlue{0.0, 0.447, 0.698};
inline constexpr Ink kVermilion{0.835, 0.369, 0.0};
inline constexpr Ink kGreen{0.0, 0.620, 0.451};
inline constexpr Ink kPurple{0.8, 0.475, 0.655};
inline constexpr Ink kOrange{0.902, 0.624, 0.0};
inline constexpr Ink kSkyBlue{0.337, 0.706, 0.914};
// Additional colours.
inline constexpr Ink kBrown{0.55, 0.27, 0.07};
inline constexpr Ink kOlive{0.55, 0.58, 0.10};
inline constexpr Ink kNavy{0.16, 0.16, 0.48};
inline constexpr Ink kBlack{0.13, 0.13, 0.15};
inline constexpr Ink kGrey{0.42, 0.44, 0.47};
inline constexpr Ink kGrid{0.88, 0.89, 0.90};
}  // namespace ink

struct Pen {
  Ink ink;
  double width = 1.0;          ///< [px]
  std::vector<double> dash{};  ///< [px] on, off ...; empty: a full line
};

enum class Align { kStart, kMiddle, kEnd };

struct Lettering {
  double size = 13.0;  ///< [px]
  Ink ink = ink::kBlack;
  Align across = Align::kStart;  ///< of the text about its place, from left to right
  Align down = Align::kMiddle;   ///< kStart: below its place
  bool bold = false;
  bool upwards = false;  ///< rotated by a quarter turn to the left
};

// Of charts.
inline constexpr Lettering kTitleLettering{17.0, ink::kBlack, Align::kMiddle, Align::kMiddle, true};
inline constexpr Lettering kAxisLettering{14.0, ink::kBlack, Align::kMiddle, Align::kMiddle};
inline constexpr Lettering kTickLettering{13.0, ink::kBlack, Align::kMiddle, Align::kMiddle};
inline constexpr Lettering kLegendLettering{13.0, ink::kBlack, Align::kStart, Align::kMiddle};

class Canvas {
 public:
  /// A white sheet, [px]; title and description are written into an SVG for screen readers.
  Canvas(ImageFormat format, int width, int height, std::string title, std::string description);
  ~Canvas();
  Canvas(const Canvas&) = delete;
  Canvas& operator=(const Canvas&) = delete;

  /// One point makes a dot.
  void line(const std::vector<Spot>& spots, const Pen& pen) { lines({spots}, pen); }
  void lines(const std::vector<std::vector<Spot>>& pieces, const Pen& pen);
  void polygon(const std::vector<Spot>& corners, const Ink& fill, const Pen& outline);
  void circle(const Spot& centre, double radius, const Ink& fill, const Pen& outline);
  void text(const Spot& at, const std::string& words, const Lettering& lettering);
  double textWidth(const std::string& words, const Lettering& lettering);

  /// Draws only inside this rectangle from now on, until unclip().
  void clip(const Spot& corner, double width, double height);
  void unclip();

  /// The whole file. Throws RunFailure. Nothing can be drawn after it.
  std::string finish();

 private:
  struct Sheet;  // Cairo's
  std::unique_ptr<Sheet> sheet_;
};

}  // namespace whirl_twin
