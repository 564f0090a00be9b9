/* Replaces the three configuration files of a demo, which the generated ones include and change. */
