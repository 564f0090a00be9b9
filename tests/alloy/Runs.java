// Runs all commands of Alloy models: paths come in, and for each command a line goes out with the
// path, its name, whether it is satisfiable, and the milliseconds it took. Java compiles and runs this file in
// one call: java -cp ALLOY Runs.java MODEL...

import edu.mit.csail.sdg.alloy4.A4Reporter;
import edu.mit.csail.sdg.ast.Command;
import edu.mit.csail.sdg.ast.Module;
import edu.mit.csail.sdg.parser.CompUtil;
import edu.mit.csail.sdg.translator.A4Options;
import edu.mit.csail.sdg.translator.A4Solution;
import edu.mit.csail.sdg.translator.TranslateAlloyToKodkod;

public class Runs {
    // The analyzer goes into sums of sets as deep as they are long.
    private static final long STACK_BYTES = 256L << 20;

    public static void main(String[] paths) throws Exception {
        int[] status = {1};
        Thread runs = new Thread(null, () -> {
            for (String path : paths) {
                all(path);
            }
            status[0] = 0;
        }, "runs", STACK_BYTES);
        runs.start();
        runs.join();
        System.exit(status[0]);
    }

    private static void all(String path) {
        A4Reporter reporter = new A4Reporter();
        Module model = CompUtil.parseEverything_fromFile(reporter, null, path);
        for (Command command : model.getAllCommands()) {
            long start = System.nanoTime();
            A4Solution solution = TranslateAlloyToKodkod.execute_command(
                reporter, model.getAllReachableSigs(), command, new A4Options());
            long ms = (System.nanoTime() - start) / 1_000_000;
            System.out.println(path + " " + command.label + " " + solution.satisfiable() + " " + ms);
        }
    }
}
