// Hint that the object can be turned. It fades in some time after the object has appeared, and out at the first action.

export class InteractionPrompt {
  private timer = 0;
  private used = false;

  /** @param hint element of the shadow tree; shown while it has the class "shown" */
  constructor(private readonly hint: HTMLElement) {}

  /** Starts to wait, unless a visitor has acted before. */
  start(delay_ms: number): void {
    if (this.used || this.timer) return;
    this.timer = setTimeout(() => this.hint.classList.add("shown"), delay_ms);
  }

  /** Ends the waiting and hides the hint; start() shows it again later. */
  stop(): void {
    clearTimeout(this.timer);
    this.timer = 0;
    this.hint.classList.remove("shown");
  }

  /** Hides the hint for good. */
  dismiss(): void {
    this.used = true;
    this.stop();
  }
}
