// SPDX-FileCopyrightText: 2026 the mapscore authors
// SPDX-License-Identifier: MIT

#include "eval/report/colours.hpp"

#include "eval/report/pictures/judgement.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <numbers>
#include <vector>

namespace mapscore::eval {
namespace {

struct Sight {
  const char* name;
  Eigen::Matrix3d of_linear_rgb;
};

/// What dichromats see, in linear RGB: Machado, Oliveira and Fernandes 2009, severity 1.
std::vector<Sight> sights() {
  std::vector<Sight> sights(4);
  sights[0] = {"normal", Eigen::Matrix3d::Identity()};
  sights[1].name = "protanopia";
  sights[1].of_linear_rgb << 0.152286, 1.052583, -0.204868, 0.114503, 0.786281, 0.099216, -0.003882,
      -0.048116, 1.051998;
  sights[2].name = "deuteranopia";
  sights[2].of_linear_rgb << 0.367322, 0.860646, -0.227968, 0.280085, 0.672501, 0.047413, -0.011820,
      0.042940, 0.968881;
  sights[3].name = "tritanopia";
  sights[3].of_linear_rgb << 1.255528, -0.076749, -0.178779, -0.078411, 0.930809, 0.147602,
      0.004733, 0.691367, 0.303900;
  return sights;
}

Eigen::Vector3d linear(const Eigen::Vector3d& srgb) {
  return srgb.unaryExpr(
      [](double c) { return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4); });
}

/// CIE L*a*b* under D65 of linear sRGB.
Eigen::Vector3d lab(const Eigen::Vector3d& linear_rgb) {
  Eigen::Matrix3d to_xyz;
  to_xyz << 0.4124564, 0.3575761, 0.1804375, 0.2126729, 0.7151522, 0.0721750, 0.0193339, 0.1191920,
      0.9503041;
  const Eigen::Vector3d white(0.95047, 1.0, 1.08883);
  const Eigen::Vector3d xyz =
      (to_xyz * linear_rgb.cwiseMax(0.0).cwiseMin(1.0)).cwiseQuotient(white);
  const Eigen::Vector3d f = xyz.unaryExpr([](double t) {
    return t > 216.0 / 24389.0 ? std::cbrt(t) : (24389.0 / 27.0 * t + 16.0) / 116.0;
  });
  return {116.0 * f.y() - 16.0, 500.0 * (f.x() - f.y()), 200.0 * (f.y() - f.z())};
}

double radians(double degrees) {
  return degrees * std::numbers::pi / 180.0;
}

double hue(double a, double b) {
  const double degrees = std::atan2(b, a) * 180.0 / std::numbers::pi;
  return degrees < 0 ? degrees + 360.0 : degrees;
}

/// 1/2 (1 - sqrt(C^7 / (C^7 + 25^7))) twice over.
double chroma_root(double C) {
  return std::sqrt(std::pow(C, 7) / (std::pow(C, 7) + std::pow(25.0, 7)));
}

/// CIEDE2000 with unit weights; equations of Sharma, Wu and Dalal 2005.
double ciede2000(const Eigen::Vector3d& p, const Eigen::Vector3d& q) {
  const double C_mean = 0.5 * (std::hypot(p.y(), p.z()) + std::hypot(q.y(), q.z()));
  const double stretch = 1.5 - 0.5 * chroma_root(C_mean);
  const double a1 = stretch * p.y(), a2 = stretch * q.y();
  const double C1 = std::hypot(a1, p.z()), C2 = std::hypot(a2, q.z());
  const double h1 = hue(a1, p.z()), h2 = hue(a2, q.z());
  const bool grey = C1 * C2 == 0.0, around = std::abs(h1 - h2) > 180.0;
  const double dh = grey ? 0.0 : h2 - h1 - (around ? std::copysign(360.0, h2 - h1) : 0.0);
  const double dL = q.x() - p.x(), dC = C2 - C1;
  const double dH = 2.0 * std::sqrt(C1 * C2) * std::sin(radians(dh / 2.0));
  const double L = 0.5 * (p.x() + q.x()), C = 0.5 * (C1 + C2);
  const double turn = around ? (h1 + h2 < 360.0 ? 360.0 : -360.0) : 0.0;
  const double h = grey ? h1 + h2 : 0.5 * (h1 + h2 + turn);
  const double T = 1.0 - 0.17 * std::cos(radians(h - 30.0)) + 0.24 * std::cos(radians(2.0 * h)) +
                   0.32 * std::cos(radians(3.0 * h + 6.0)) -
                   0.20 * std::cos(radians(4.0 * h - 63.0));
  const double off = (L - 50.0) * (L - 50.0);
  const double S_L = 1.0 + 0.015 * off / std::sqrt(20.0 + off);
  const double S_C = 1.0 + 0.045 * C, S_H = 1.0 + 0.015 * C * T;
  const double theta = 30.0 * std::exp(-std::pow((h - 275.0) / 25.0, 2));
  const double R_T = -std::sin(radians(2.0 * theta)) * 2.0 * chroma_root(C);
  return std::sqrt(std::pow(dL / S_L, 2) + std::pow(dC / S_C, 2) + std::pow(dH / S_H, 2) +
                   R_T * dC / S_C * dH / S_H);
}

Eigen::Vector3d seen_by(const Sight& sight, const Eigen::Vector3d& srgb) {
  return lab(sight.of_linear_rgb * linear(srgb));
}

Eigen::Vector3d srgb_of(const Colour& colour) {
  return Eigen::Vector3d(colour.r, colour.g, colour.b) / 255.0;
}

// Pairs 1, 7, 13, 17 and 20 of table 1 of Sharma, Wu and Dalal.
TEST(ColourDifference, IsCiede2000) {
  const auto difference = [](double L1, double a1, double b1, double L2, double a2, double b2) {
    return ciede2000({L1, a1, b1}, {L2, a2, b2});
  };
  EXPECT_NEAR(difference(50, 2.6772, -79.7751, 50, 0, -82.7485), 2.0425, 5e-5);
  EXPECT_NEAR(difference(50, 0, 0, 50, -1, 2), 2.3669, 5e-5);
  EXPECT_NEAR(difference(50, 2.5, 0, 50, 0, -2.5), 4.3065, 5e-5);
  EXPECT_NEAR(difference(50, 2.5, 0, 73, 25, -18), 27.1492, 5e-5);
  EXPECT_NEAR(difference(60.2574, -34.0099, 36.2677, 60.4626, -34.1751, 39.4387), 1.2644, 5e-5);
}

TEST(PictureColours, OfTheVerdictsAreToldApartByTheColourBlind) {
  for (const Sight& sight : sights())
    for (const Verdict a : kVerdicts)
      for (const Verdict b : kVerdicts) {
        if (a >= b) continue;
        EXPECT_GT(
            ciede2000(seen_by(sight, srgb_of(colour_of(a))), seen_by(sight, srgb_of(colour_of(b)))),
            27.0)
            << sight.name << ": " << name_of(a) << " and " << name_of(b);
      }
}

// The sides of a cube get from 0.8 to 1 of its colour; the pale scene is grey from 0.57 to 0.97.
TEST(PictureColours, OfTheVerdictsStandOutWhereTheyAreShaded) {
  for (const Sight& sight : sights())
    for (const Verdict a : kVerdicts)
      for (const double light : {0.8, 0.9, 1.0}) {
        const Eigen::Vector3d shaded = seen_by(sight, light * srgb_of(colour_of(a)));
        for (double grey = 0.57; grey <= 1.0; grey += 0.01) {
          EXPECT_GT(ciede2000(shaded, seen_by(sight, Eigen::Vector3d::Constant(grey))), 18.0)
              << sight.name << ": " << name_of(a) << " on grey " << grey;
        }
        for (const Verdict b : kVerdicts) {
          if (a == b) continue;
          EXPECT_GT(ciede2000(shaded, seen_by(sight, srgb_of(colour_of(b)))), 14.0)
              << sight.name << ": " << name_of(a) << " in shade and " << name_of(b);
        }
      }
}

TEST(PictureColours, OfTheCausesInFiguresAreToldApartByTheColourBlind) {
  const std::vector<Colour> causes{kNearColour,        kLeakColour,       kFloatingColour,
                                   kMislabelledColour, kUnlabelledColour, kMissedColour};
  for (const Sight& sight : sights())
    for (std::size_t a = 0; a < causes.size(); ++a)
      for (std::size_t b = 0; b < a; ++b)
        EXPECT_GT(ciede2000(seen_by(sight, srgb_of(causes[a])), seen_by(sight, srgb_of(causes[b]))),
                  20.0)
            << sight.name << ": " << b << " and " << a;
}

}  // namespace
}  // namespace mapscore::eval
