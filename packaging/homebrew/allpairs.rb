class Allpairs < Formula
  desc "Exact, deterministic broad-phase collision detection"
  homepage "https://example.org/allpairs"
  url "https://example.org/allpairs/allpairs-0.1.0.tar.gz"
  sha256 "0000000000000000000000000000000000000000000000000000000000000000"
  license "MIT"

  depends_on "cmake" => :build
  depends_on "highway"
  depends_on "tbb"

  def install
    args = %w[
      -DBUILD_SHARED_LIBS=ON
      -DALLPAIRS_BUILD_APP=OFF
      -DALLPAIRS_BUILD_SCENE=OFF
      -DALLPAIRS_BUILD_TESTS=OFF
      -DALLPAIRS_BUILD_EXAMPLES=OFF
      -DALLPAIRS_FCL=OFF
      -DALLPAIRS_MPI=OFF
      -DALLPAIRS_SOFA=OFF
    ]
    system "cmake", "-S", ".", "-B", "build", *args, *std_cmake_args
    system "cmake", "--build", "build"
    system "cmake", "--install", "build"
  end

  test do
    (testpath/"test.cpp").write <<~CPP
      #include <allpairs/Overlaps.h>
      #include <vector>
      int main() {
        const std::vector<allpairs::Box> boxes{{{0, 0, 0}, {1, 1, 1}}, {{1, 1, 1}, {2, 2, 2}}};
        return allpairs::overlaps(boxes).size() == 1 ? 0 : 1;
      }
    CPP
    system ENV.cxx, "-std=c++20", "test.cpp", "-I#{include}", "-L#{lib}", "-lallpairs", "-o", "test"
    system "./test"
  end
end
