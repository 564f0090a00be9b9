# For Homebrew: `cargo xtask release` fills in what is between `@`.
class Sensedsl < Formula
  desc "From a list of sensors to the best wiring, its firmware and its host application"
  homepage "@REPOSITORY@"
  url "@DOWNLOADS@/sensedsl-@VERSION@.tar.gz"
  sha256 "@SHA256 sensedsl-@VERSION@.tar.gz@"
  license any_of: ["MIT", "Apache-2.0"]

  depends_on "rust" => :build

  def install
    system "cargo", "install", *std_cargo_args(path: "crates/sensedsl")
    generate_completions_from_executable(bin/"sensedsl", "completions")
    mkdir "man1"
    system bin/"sensedsl", "--quiet", "man", "man1"
    man1.install Dir["man1/*.1"]
  end

  test do
    (testpath/"robot.sense").write <<~SENSE
      board STM32F407G_DISC1 { sensor Light returns uint16 { id = 1; type = analog; } }
    SENSE
    assert_match "proved optimal", shell_output("#{bin}/sensedsl solve robot.sense")
  end
end
